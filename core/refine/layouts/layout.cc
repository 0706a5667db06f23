#include "core/refine/layouts/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/enum_index.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

class Hanger {
 public:
  Hanger(const Layout& layout, const body::Body& body, const body::PartSelection& parts,
         bool symmetric)
      : layout_(layout), body_(body), parts_(parts), skeleton_(body), graph_(symmetric) {}

  capsule::MirroredSet Hang() {
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) AddNode(layout_.nodes[i]);
    for (const LayoutEdge& e : layout_.edges) AddEdge(e);
    for (int part = 0; part < body::kChainCount; ++part) AddMissingChain(body::Part(part));
    if (graph_.spheres().empty()) AddBall();
    return graph_;
  }

 private:
  void AddNode(const LayoutNode& node) {
    const int left = Place(node, Side::kLeft);
    int right = left;
    if (node.paired) {
      right = graph_.is_mirrored() ? (left < 0 ? -1 : left + 1) : Place(node, Side::kRight);
    }
    index_.push_back({left, right});
  }

  int Place(const LayoutNode& node, Side side) {
    const body::Part part = PartOf(node.bone, side);
    const std::optional<Vec3> center = skeleton_.Position(node.bone, side, node.place);
    if (!center || !parts_.Includes(part)) return -1;
    if (const std::size_t chain = Index(part); chain < chain_has_sphere_.size()) {
      chain_has_sphere_[chain] = true;
    }
    const double radius = node.radius * skeleton_.bone(node.bone, side)->radius_m;
    return graph_.AddSphere({*center, std::max(kLeastHungRadiusM, radius)}, !node.paired);
  }

  void AddEdge(const LayoutEdge& edge) {
    const auto [a_left, a_right] = index_[edge.a];
    const auto [b_left, b_right] = index_[edge.b];
    const auto tie = [this](int a, int b) {
      if (a >= 0 && b >= 0) graph_.AddCapsule(a, b);
    };
    tie(a_left, edge.crossed ? b_right : b_left);
    tie(a_right, edge.crossed ? b_left : b_right);
  }

  // A selected chain that no bone led to: spheres along its medial curve.
  void AddMissingChain(body::Part part) {
    const auto& chain = body_.chain(part);
    const bool right = part == body::Part::kRightArm || part == body::Part::kRightLeg;
    if (!chain || !parts_.Includes(part) || chain_has_sphere_[Index(part)]) return;
    if (graph_.is_mirrored() && right) return;
    int last = -1;
    for (const double share : {0.05, 0.5, 0.95}) {
      const Vec3 center = chain->PointAt(share * chain->length_m());
      const int v = graph_.AddSphere({center, std::max(kLeastHungRadiusM, SkinDistance(center))},
                                     part == body::Part::kTorso);
      if (last >= 0) graph_.AddCapsule(last, v);
      last = v;
    }
  }

  void AddBall() {
    const Vec3 center = 0.5 * (body_.mesh.box_min() + body_.mesh.box_max());
    graph_.AddSphere({center, std::max(kLeastHungRadiusM, SkinDistance(center))}, true);
  }

  [[nodiscard]] double SkinDistance(const Vec3& point) const {
    double least = std::numeric_limits<double>::max();
    for (const Vec3& v : body_.mesh.vertices()) least = std::min(least, (v - point).squaredNorm());
    return std::sqrt(least);
  }

  const Layout& layout_;
  const body::Body& body_;
  const body::PartSelection& parts_;
  Skeleton skeleton_;
  capsule::MirroredSet graph_;
  std::vector<std::array<int, 2>> index_;  // by layout node: left or only, right; -1: left out
  std::array<bool, body::kChainCount> chain_has_sphere_{};
};

}  // namespace

capsule::MirroredSet HangLayout(const Layout& layout, const body::Body& body,
                                const body::PartSelection& parts, bool symmetric) {
  return Hanger(layout, body, parts, symmetric).Hang();
}

}  // namespace capfit::refine
