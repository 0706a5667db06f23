#include "core/section/plane_section.h"

#include <algorithm>
#include <span>
#include <utility>

namespace capfit::section {
namespace {

// A cut through one triangle: it enters over the edge that comes down through the plane and leaves
// over the one that goes up. Named by their vertices, lower index first.
using EdgeKey = std::uint64_t;

EdgeKey KeyOf(std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  return (static_cast<EdgeKey>(a) << 32) | b;
}

struct Segment {
  EdgeKey from = 0;
  EdgeKey to = 0;
};

class Cutter {
 public:
  Cutter(const mesh::BodyMesh& mesh, const geometry::PlaneFrame& plane)
      : vertices_(mesh.vertices()), plane_(plane) {
    const Eigen::Vector3d normal = plane.Normal();
    heights_.reserve(vertices_.size());
    for (const Eigen::Vector3d& v : vertices_) heights_.push_back((v - plane.origin_m).dot(normal));
    for (const mesh::Triangle& triangle : mesh.triangles()) AddSegment(triangle);
  }

  std::vector<SectionLoop> Loops() const {
    // Each edge in the plane is the start of one segment: sorted, the next one is found by search.
    std::vector<std::pair<EdgeKey, std::size_t>> starts;
    for (std::size_t i = 0; i < segments_.size(); ++i) starts.emplace_back(segments_[i].from, i);
    std::sort(starts.begin(), starts.end());
    std::vector<bool> used(segments_.size(), false);
    std::vector<SectionLoop> loops;
    for (std::size_t first = 0; first < segments_.size(); ++first) {
      if (used[first]) continue;
      SectionLoop loop;
      for (std::size_t i = first; !used[i];) {
        used[i] = true;
        loop.push_back(PointOn(segments_[i].from));
        const auto next = std::lower_bound(starts.begin(), starts.end(),
                                           std::make_pair(segments_[i].to, std::size_t{0}));
        if (next == starts.end() || next->first != segments_[i].to) break;  // not a closed mesh
        i = next->second;
      }
      loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  bool IsAbove(std::uint32_t v) const { return heights_[v] >= 0.0; }

  void AddSegment(const mesh::Triangle& t) {
    const int above = IsAbove(t[0]) + IsAbove(t[1]) + IsAbove(t[2]);
    if (above == 0 || above == 3) return;
    Segment segment;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      if (IsAbove(a) && !IsAbove(b)) segment.from = KeyOf(a, b);
      if (!IsAbove(a) && IsAbove(b)) segment.to = KeyOf(a, b);
    }
    segments_.push_back(segment);
  }

  SectionPoint PointOn(EdgeKey key) const {
    const auto a = static_cast<std::uint32_t>(key >> 32);
    const auto b = static_cast<std::uint32_t>(key & 0xFFFFFFFFu);
    const double t = heights_[a] / (heights_[a] - heights_[b]);  // signs differ, so never 0 / 0
    return {plane_.ToPlane(vertices_[a] + t * (vertices_[b] - vertices_[a])), t < 0.5 ? a : b};
  }

  std::span<const Eigen::Vector3d> vertices_;
  const geometry::PlaneFrame& plane_;
  std::vector<double> heights_;
  std::vector<Segment> segments_;
};

}  // namespace

std::vector<SectionLoop> CutMesh(const mesh::BodyMesh& mesh, const geometry::PlaneFrame& plane) {
  return Cutter(mesh, plane).Loops();
}

}  // namespace capfit::section
