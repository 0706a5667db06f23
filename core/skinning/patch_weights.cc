#include "core/skinning/patch_weights.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>

#include "core/skinning/spherical_triangles.h"

namespace capfit::skinning {
namespace {

// A patch whose radius is more than this share of its distance is summed up by its parts.
constexpr float kFarShare = 0.15F;
// Triangles of vertices nearer than so many of their longest edges are summed exactly.
constexpr float kNearEdges = 1.75F;
// Keeps what stands for a vertex finite where the centre touches it, as a share of its area.
constexpr float kSoftShare = 0.05F;
// What a patch's coarseness may matter, as a share of the mesh's diagonal: 1 mm on a body. (The
// errors of patches have all directions, and most of each is mended.)
constexpr float kLimitShare = 6.5e-4F;
// A part of the body that weighs more than this share gets so many patches, for which the limit is
// lowered at most so far: four weights can be mended to have their sum and moment right.
constexpr float kNegligibleShare = 1.5e-3F;
constexpr std::size_t kLeastOfPart = 5;
constexpr float kMostLowered = 1.0F / 64.0F;
// What is seen edge-on counts like this share of its area.
constexpr float kEdgeOnShare = 0.3F;
// By so much the limit is changed when there are too many or too few patches, and how often.
constexpr float kLimitFactor = 1.3F;
constexpr int kMostChanges = 40;
// A centre nearer to a vertex than this share of the diagonal is that vertex.
constexpr double kTouchingShare = 1e-9;
// How much a triangle that the centre lies on outweighs all others.
constexpr double kHitShare = 1e4;

float Dot(const Eigen::Array4f& a, const Eigen::Array4f& b) { return (a * b).sum(); }

class Viewer {
 public:
  Viewer(const Eigen::Vector3d& center, const SurfaceTree& tree, const PatchCounts& counts)
      : center_(center), tree_(tree), counts_(counts) {
    const Eigen::Vector3d relative = center - tree.origin();
    relative_ << relative.cast<float>(), 0.0F;
    seen_.reserve(counts.most + 1);
    patches_.reserve(counts.most + 1);
  }

  std::vector<SeenPatch> Run() && {
    Divide();
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      sums_.setZero();
      if (patches_[i] != nullptr) {
        AddPatch(*patches_[i]);
      } else {
        AddVertex(tree_.order()[seen_[i].begin]);
      }
      seen_[i].weight = sums_[3];
      seen_[i].moment = sums_.head<3>().matrix().cast<double>();
    }
    AddNearTriangles();
    if (hit_) PutHit();
    return std::move(seen_);
  }

 private:
  // Finds the patches, and for each of them what it is in the tree.
  void Divide() {
    float sizes = 0.0F;
    AddSizes(tree_.root(), sizes);
    sizes_ = sizes;
    float limit = kLimitShare * static_cast<float>(tree_.mesh().diagonal()) * sizes;
    bool is_raised = false;
    for (int change = 0; change < kMostChanges; ++change) {
      seen_.clear();
      patches_.clear();
      if (!CutParts(tree_.root(), limit)) {
        limit *= kLimitFactor;
        is_raised = true;
      } else if (seen_.size() < counts_.least && !is_raised) {
        limit /= 2.0F;
      } else {
        return;
      }
    }
  }

  // From the centre, and a 1.
  [[nodiscard]] Eigen::Array4f To(const SurfacePatch& patch) const {
    return patch.middle - relative_;
  }

  // Without the 1.
  static float SquareOf(const Eigen::Array4f& to) { return to.head<3>().square().sum(); }

  // Roughly the sum of the weights' sizes.
  void AddSizes(const SurfacePatch& patch, float& sizes) const {
    const Eigen::Array4f to = To(patch);
    const float square = SquareOf(to);
    if (!patch.is_bucket() && patch.square_radius > 0.25F * square) {
      for (const std::int32_t part : patch.parts) AddSizes(tree_.patch(part), sizes);
      return;
    }
    const float soft = square + patch.square_radius;
    sizes += Seen(patch, to, soft) / (soft * soft);
  }

  // How much of the patch is seen. (What is seen edge-on or from both sides has no weight, but may
  // hold parts that have.)
  static float Seen(const SurfacePatch& patch, const Eigen::Array4f& to, float square) {
    return kEdgeOnShare * patch.area * std::sqrt(square) + std::abs(Dot(patch.area_vector, to));
  }

  // Weight times how far its vertices may be from where they are taken for.
  [[nodiscard]] bool Matters(const SurfacePatch& patch, float limit) const {
    const Eigen::Array4f to = To(patch);
    const float square = SquareOf(to) + patch.square_radius;
    return Seen(patch, to, square) * std::sqrt(patch.square_radius) > limit * square * square;
  }

  // Down to parts of the body, each of which gets patches enough to have its weights mended.
  // False: there are too many.
  bool CutParts(const SurfacePatch& patch, float limit) {
    if (!patch.is_of_one && !patch.is_bucket()) {
      return CutParts(tree_.patch(patch.parts[0]), limit) &&
             CutParts(tree_.patch(patch.parts[1]), limit);
    }
    const std::size_t first = seen_.size();
    float size = 0.0F;
    AddSizes(patch, size);
    const float least = size > kNegligibleShare * sizes_ ? limit * kMostLowered : limit;
    for (float lowered = limit;; lowered *= 0.5F) {
      if (!Cut(patch, lowered)) return false;
      if (seen_.size() - first >= kLeastOfPart || lowered <= least) break;
      seen_.resize(first);
      patches_.resize(first);
    }
    for (std::size_t i = first; i < seen_.size(); ++i) {
      seen_[i].part = static_cast<std::uint32_t>(first);
    }
    return true;
  }

  bool Cut(const SurfacePatch& patch, float limit) {
    if (patch.is_of_one && !Matters(patch, limit)) return Put(patch.begin, patch.end, &patch);
    const std::size_t first = seen_.size();
    if (!patch.is_bucket()) {
      for (const std::int32_t part : patch.parts) {
        if (!Cut(tree_.patch(part), limit)) return false;
      }
    } else {
      for (std::uint32_t i = patch.begin; i < patch.end; ++i) {
        if (!Put(i, i + 1, nullptr)) return false;
      }
    }
    if (patch.is_of_one && seen_.size() - first <= counts_.group) {
      for (std::size_t i = first; i < seen_.size(); ++i) {
        seen_[i].group = static_cast<std::uint32_t>(first);
      }
    }
    return true;
  }

  bool Put(std::uint32_t begin, std::uint32_t end, const SurfacePatch* patch) {
    SeenPatch seen;
    seen.begin = begin;
    seen.end = end;
    seen.group = static_cast<std::uint32_t>(seen_.size());
    seen_.push_back(seen);
    patches_.push_back(patch);
    return seen_.size() <= counts_.most;
  }

  void AddPatch(const SurfacePatch& patch) {
    const Eigen::Array4f to = To(patch);
    const float square = SquareOf(to);
    if (patch.square_radius <= kFarShare * kFarShare * square &&
        kNearEdges * kNearEdges * patch.square_reach <= square) {
      sums_ += FarWeight(patch, Dot(patch.area_vector, to), square) * to;
    } else if (!patch.is_bucket()) {
      for (const std::int32_t part : patch.parts) AddPatch(tree_.patch(part));
    } else {
      for (std::uint32_t i = patch.begin; i < patch.end; ++i) AddVertex(tree_.order()[i]);
    }
  }

  // Of a small patch a long way off, `straight` its area vector along the way: to the second order
  // in its radius over the distance, for a patch that is round and bent alike in all directions.
  // The integrals of n . d / d^4 over a disc and over a cap.
  static float FarWeight(const SurfacePatch& patch, float straight, float square) {
    const float cosine_square =
        std::min(1.0F, straight * straight / (patch.area * patch.area * square));
    const float of_disc =
        straight * (1.0F + patch.square_radius / square * (4.0F - 6.0F * cosine_square));
    const float of_bulge = patch.bulge * (2.0F * cosine_square - 1.0F);
    return (of_disc + of_bulge) / (square * square);
  }

  void AddVertex(std::uint32_t vertex) {
    const Eigen::Array4f& share = tree_.ShareOf(vertex);
    Eigen::Array4f to;
    to << (tree_.mesh().vertices()[vertex] - center_).cast<float>(), 0.0F;
    const float square = Dot(to, to);
    if (square < kNearEdges * kNearEdges * tree_.SquareReachOf(vertex)) near_.push_back(vertex);
    const float soft = square + kSoftShare * share[3];
    const float weight = Dot(share, to) / (soft * soft);
    to[3] = 1.0F;
    sums_ += weight * to;
  }

  // The weight of a piece of surface as if all of it were in its vertex.
  static double Lumped(const Eigen::Vector3d& area_vector, const Eigen::Vector3d& to,
                       double vertex_area) {
    const double soft = to.squaredNorm() + static_cast<double>(kSoftShare) * vertex_area;
    return area_vector.dot(to) / (soft * soft);
  }

  // Puts what triangles near the centre really weigh in place of what was taken for it.
  void AddNearTriangles() {
    for (const std::uint32_t vertex : near_) {
      const mesh::HalfEdge first = tree_.HalfEdgeFrom(vertex);
      mesh::HalfEdge h = first;
      do {
        if (h % 3 == 0) AddNearTriangle(h / 3);  // once, though it may be near three vertices
        h = tree_.mesh().mates()[mesh::PreviousInTriangle(h)];
      } while (h != first);
    }
    WeighNearTriangles();
  }

  void AddNearTriangle(std::uint32_t index) {
    const mesh::Triangle& triangle = tree_.mesh().triangles()[index];
    std::array<Eigen::Vector3d, 3>& corners = corners_[triangle_count_];
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = tree_.mesh().vertices()[triangle[k]] - center_;
    }
    if (TouchesCorner(triangle, corners)) return;
    triangles_[triangle_count_++] = triangle;
    if (triangle_count_ == kLanes) WeighNearTriangles();
  }

  void WeighNearTriangles() {
    if (triangle_count_ == 0) return;
    const std::array<TriangleWeights, kLanes> weights =
        MeanValueTriangles(std::span(corners_).first(triangle_count_));
    for (std::size_t i = 0; i < triangle_count_; ++i) {
      if (!weights[i].is_hit) {
        Replace(triangles_[i], corners_[i], weights[i]);
      } else if (!hit_) {
        hit_ = {triangles_[i], weights[i].weights};
      }
    }
    triangle_count_ = 0;
  }

  void Replace(const mesh::Triangle& triangle, const std::array<Eigen::Vector3d, 3>& corners,
               const TriangleWeights& exact) {
    const Eigen::Vector3d third = (corners[1] - corners[0]).cross(corners[2] - corners[0]) / 6.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double area = tree_.ShareOf(triangle[k])[3];
      PutWeight(triangle[k], exact.weights[k] - Lumped(third, corners[k], area));
    }
  }

  bool TouchesCorner(const mesh::Triangle& triangle,
                     const std::array<Eigen::Vector3d, 3>& corners) {
    const double touching = kTouchingShare * tree_.mesh().diagonal();
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k].squaredNorm() > touching * touching) continue;
      if (!hit_) hit_ = {{triangle[k], triangle[k], triangle[k]}, {1.0, 0.0, 0.0}};
      return true;
    }
    return false;
  }

  void PutHit() {
    double sizes = 0.0;
    for (const SeenPatch& seen : seen_) sizes += std::abs(seen.weight);
    for (std::size_t k = 0; k < 3; ++k) {
      PutWeight(hit_->vertices[k], kHitShare * sizes * hit_->weights[k]);
    }
  }

  void PutWeight(std::uint32_t vertex, double weight) {
    const auto behind = std::upper_bound(
        seen_.begin(), seen_.end(), tree_.PlaceOf(vertex),
        [](std::uint32_t place, const SeenPatch& seen) { return place < seen.begin; });
    SeenPatch& seen = *std::prev(behind);
    seen.weight += weight;
    seen.moment += weight * (tree_.mesh().vertices()[vertex] - center_);
  }

  const Eigen::Vector3d& center_;
  const SurfaceTree& tree_;
  const PatchCounts& counts_;
  std::vector<SeenPatch> seen_;
  std::vector<const SurfacePatch*> patches_;  // of each; null for a single point
  Eigen::Array4f relative_;                   // the centre, relative to the tree's origin, and a 0
  Eigen::Array4f sums_;                       // of weight * (place, 1)
  std::vector<std::uint32_t> near_;           // vertices
  // Of near triangles those that wait to be weighed together.
  std::array<mesh::Triangle, kLanes> triangles_;
  std::array<std::array<Eigen::Vector3d, 3>, kLanes> corners_;
  std::size_t triangle_count_ = 0;
  float sizes_ = 0.0F;             // roughly the sum of the weights' sizes
  std::optional<SurfaceHit> hit_;  // the first triangle or vertex that the centre touches
};

}  // namespace

std::vector<SeenPatch> PatchesSeenFrom(const Eigen::Vector3d& center, const SurfaceTree& tree,
                                       const PatchCounts& counts) {
  return Viewer(center, tree, counts).Run();
}

}  // namespace capfit::skinning
