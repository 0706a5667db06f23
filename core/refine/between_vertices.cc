#include "core/refine/between_vertices.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/refine/cone.h"

namespace capfit::refine {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr float kNoticedM = 7e-4f;
constexpr float kAllowedM = 5e-4f;
constexpr int kMaxDepth = 6;

struct Piece {
  std::array<Vec3f, 3> corners;
  int depth;
};

class TriangleChecker {
 public:
  TriangleChecker(const std::vector<Cone>& cones, float tolerance_m)
      : cones_(cones), tolerance_m_(tolerance_m) {}

  // Appends the point of the triangle that sticks out most, where that is noticed.
  void Check(const std::array<Vec3f, 3>& corners, std::vector<CoverPoint>& sticking) {
    worst_ = tolerance_m_ + kNoticedM;
    found_ = false;
    stack_.assign(1, {corners, 0});
    while (!stack_.empty()) {
      const Piece piece = stack_.back();
      stack_.pop_back();
      Visit(piece);
    }
    if (found_) sticking.push_back({point_, tolerance_m_ + kAllowedM});
  }

 private:
  void Visit(const Piece& piece) {
    const auto& [a, b, c] = piece.corners;
    const Vec3f center = (a + b + c) / 3.0f;
    const float reach = std::max({(a - center).norm(), (b - center).norm(), (c - center).norm()});
    const float distance = Distance(center);
    if (distance > worst_) {
      worst_ = distance;
      point_ = center;
      found_ = true;
    }
    // The distance changes by no more than the way.
    if (distance + reach <= worst_ || piece.depth == kMaxDepth || InOne(piece)) return;
    const Vec3f ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
    for (const std::array<Vec3f, 3>& part : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                             std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
      stack_.push_back({part, piece.depth + 1});
    }
  }

  [[nodiscard]] float Distance(const Vec3f& p) const {
    float least = std::numeric_limits<float>::max();
    for (const Cone& cone : cones_) {
      least = std::min(least, SignedDistance(cone, p.x(), p.y(), p.z()));
    }
    return least;
  }

  [[nodiscard]] bool InOne(const Piece& piece) const {
    return std::any_of(cones_.begin(), cones_.end(), [&](const Cone& cone) {
      return std::all_of(piece.corners.begin(), piece.corners.end(), [&](const Vec3f& p) {
        return SignedDistance(cone, p.x(), p.y(), p.z()) <= tolerance_m_;
      });
    });
  }

  const std::vector<Cone>& cones_;
  float tolerance_m_;
  float worst_ = 0.0f;
  bool found_ = false;
  Vec3f point_ = Vec3f::Zero();
  std::vector<Piece> stack_;
};

}  // namespace

std::vector<CoverPoint> StickingPoints(const body::Body& body, const body::PartSelection& parts,
                                       double tolerance_m, const CapsuleGraph& graph) {
  const std::vector<Cone> cones = ConesOf(graph);
  std::vector<CoverPoint> corners;
  for (const Eigen::Vector3d& v : body.mesh.vertices()) corners.push_back({v.cast<float>(), 0.0f});
  std::vector<int> holder(corners.size(), -1);
  for (std::size_t v = 0; v < corners.size(); ++v) {
    const Vec3f& p = corners[v].position_m;
    float least = std::numeric_limits<float>::max();
    for (std::size_t j = 0; j < cones.size(); ++j) {
      const float d = SignedDistance(cones[j], p.x(), p.y(), p.z());
      if (d < least) least = d, holder[v] = static_cast<int>(j);
    }
  }
  TriangleChecker checker(cones, static_cast<float>(tolerance_m));
  std::vector<CoverPoint> sticking;
  for (const mesh::Triangle& t : body.mesh.triangles()) {
    const auto selected = [&](std::uint32_t v) {
      return parts.Includes(body::PartOf(body.vertex_segments[v]));
    };
    if (!selected(t[0]) || !selected(t[1]) || !selected(t[2])) continue;
    if (holder[t[0]] == holder[t[1]] && holder[t[1]] == holder[t[2]]) continue;
    checker.Check({corners[t[0]].position_m, corners[t[1]].position_m, corners[t[2]].position_m},
                  sticking);
  }
  if (graph.symmetric) {
    for (CoverPoint& p : sticking) p.position_m.x() = std::abs(p.position_m.x());
  }
  return sticking;
}

}  // namespace capfit::refine
