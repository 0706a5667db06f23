#include "core/mesh/close_holes.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "absl/container/flat_hash_set.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/mesh/open_loops.h"
#include "core/mesh/surface_sums.h"
#include "core/mesh/triangulate_loop.h"

namespace capfit::mesh {
namespace {

// The filling of least area costs n^3 / 6 steps of some nanoseconds. A loop of 400 edges (a waist
// cut through 100,000 triangles) takes about 0.1 s; a mesh may ask for four of these in all. What
// is beyond is filled by cutting ears.
constexpr std::size_t kLongestExactLoop = 400;
constexpr std::size_t kExactSteps = 45'000'000;

class HoleCloser {
 public:
  HoleCloser(std::span<const Eigen::Vector3d> positions, Surface& surface)
      : positions_(positions), surface_(surface) {}

  absl::StatusOr<ClosedHoles> Run() {
    const std::optional<std::vector<OpenLoop>> loops = FindOpenLoops(surface_);
    if (!loops.has_value()) {
      return Refused(ErrorReason::kHoleNotClosed,
                     "the open edges of the surface do not form loops that could be closed; mend "
                     "it in a modelling program");
    }
    NoteEdges(*loops);
    for (const OpenLoop& loop : *loops) CAPFIT_RETURN_IF_ERROR(Close(loop));
    return report_;
  }

 private:
  static std::uint64_t Key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  // All edges between two vertices of holes: no filling may use one again.
  void NoteEdges(const std::vector<OpenLoop>& loops) {
    std::vector<bool> on_hole(positions_.size(), false);
    for (const OpenLoop& loop : loops) {
      for (const HalfEdge h : loop) on_hole[StartOf(surface_.triangles, h)] = true;
    }
    for (HalfEdge h = 0; h < surface_.mate.size(); ++h) {
      const std::uint32_t a = StartOf(surface_.triangles, h);
      const std::uint32_t b = EndOf(surface_.triangles, h);
      if (on_hole[a] && on_hole[b]) edges_.insert(Key(a, b));
    }
  }

  absl::Status Close(const OpenLoop& loop) {
    if (loop.size() == 2) {  // two open edges between the same vertices: a slit
      surface_.mate[loop[0]] = loop[1];
      surface_.mate[loop[1]] = loop[0];
      return absl::OkStatus();
    }
    // The filling runs the loop backwards, as a neighbour must.
    std::vector<std::uint32_t> corners;
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = loop.size(); i-- > 0;) {
      corners.push_back(EndOf(surface_.triangles, loop[i]));
      points.push_back(positions_[corners.back()]);
    }
    const std::optional<std::vector<Triangle>> filling = Fill(corners, points);
    if (!filling.has_value()) {
      return Refused(ErrorReason::kHoleNotClosed,
                     absl::StrCat("a hole of ", loop.size(),
                                  " edges cannot be closed with the vertices around it; close "
                                  "it in a modelling program"));
    }
    Report(points, *filling);
    Append(loop, corners, *filling);
    return absl::OkStatus();
  }

  std::optional<std::vector<Triangle>> Fill(const std::vector<std::uint32_t>& corners,
                                            const std::vector<Eigen::Vector3d>& points) {
    const MayJoin may_join = [&](std::uint32_t i, std::uint32_t k) {
      return !edges_.contains(Key(corners[i], corners[k]));
    };
    const std::size_t n = corners.size();
    const std::size_t steps = n * n * n / 6;
    if (n > kLongestExactLoop || steps > steps_left_) return FillByCuttingEars(points, may_join);
    steps_left_ -= steps;
    return FillBySmallestArea(points, may_join);
  }

  void Report(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& filling) {
    ++report_.holes;
    for (const Triangle& t : filling) {
      report_.area += Area(points, t);
    }
    double perimeter = (points.front() - points.back()).norm();
    Eigen::Vector3d from_first = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i < points.size(); ++i) {
      perimeter += (points[i] - points[i - 1]).norm();
      from_first += points[i] - points[0];
    }
    if (perimeter <= report_.longest_perimeter) return;
    report_.longest_perimeter = perimeter;
    report_.largest_middle = points[0] + from_first / static_cast<double>(points.size());
  }

  void Append(const OpenLoop& loop, const std::vector<std::uint32_t>& corners,
              const std::vector<Triangle>& filling) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    const auto first = static_cast<HalfEdge>(surface_.mate.size());
    const EdgeMates inner = FindEdgeMates(filling, n);
    for (const Triangle& t : filling) {
      surface_.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
      for (int k = 0; k < 3; ++k) edges_.insert(Key(corners[t[k]], corners[t[(k + 1) % 3]]));
    }
    surface_.mate.resize(first + inner.mate.size());
    for (HalfEdge h = 0; h < inner.mate.size(); ++h) {
      if (inner.mate[h] != kNoMate) {
        surface_.mate[first + h] = first + inner.mate[h];
        continue;
      }
      // Corner i is the end of loop[n - 1 - i], whose start is corner i + 1.
      const std::uint32_t i = StartOf(filling, h);
      const HalfEdge outer = loop[n - 1 - i];
      surface_.mate[first + h] = outer;
      surface_.mate[outer] = first + h;
    }
  }

  std::span<const Eigen::Vector3d> positions_;
  Surface& surface_;
  absl::flat_hash_set<std::uint64_t> edges_;
  std::size_t steps_left_ = kExactSteps;
  ClosedHoles report_;
};

}  // namespace

absl::StatusOr<ClosedHoles> CloseHoles(std::span<const Eigen::Vector3d> positions,
                                       Surface& surface) {
  return HoleCloser(positions, surface).Run();
}

}  // namespace capfit::mesh
