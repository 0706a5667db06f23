#include "core/solid/shells.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/mesh/join_triangles.h"
#include "core/mesh/open_loops.h"
#include "core/mesh/surface_parts.h"
#include "core/mesh/surface_sums.h"
#include "core/mesh/triangulate_loop.h"

namespace capfit::solid {
namespace {

// The filling of least area costs n^3 / 6 steps: half a millisecond for 64 corners, of which a rim
// of a sleeve has about as many. What is longer is filled between some of its vertices, and the
// slivers that remain along the rim are closed by themselves.
constexpr std::size_t kMostCorners = 64;
// Steps of that kind for all rims together, some tens of milliseconds. What is beyond is filled by
// fans: a file with thousands of long rims is no clothing.
constexpr std::size_t kMostSteps = 4'000'000;

class ShellFinder {
 public:
  ShellFinder(std::span<const Eigen::Vector3d> positions, Shells& shells)
      : positions_(positions), shells_(shells) {}

  void Run(mesh::JoinedTriangles joined) {
    mesh::Surface& surface = joined.surface;
    const mesh::SurfaceParts parts = mesh::OrientParts(positions_, surface);
    shells_.triangles = surface.triangles;
    shells_.shell_of_triangle = parts.part_of_triangle;
    for (const mesh::Triangle& t : shells_.triangles) {
      shells_.area += mesh::AreaVector(positions_, t).norm();
    }
    for (mesh::OpenLoop& loop : mesh::FindOpenLoops(surface)) Close(std::move(loop));
    shells_.volumes.assign(parts.parts.size(), 0.0);
    shells_.areas.assign(parts.parts.size(), 0.0);
    TurnOutward();
  }

 private:
  void Close(mesh::OpenLoop loop) {
    if (loop.vertices.size() < 3) return;
    Rim rim;
    rim.shell = shells_.shell_of_triangle[loop.triangle];
    rim.vertices = std::move(loop.vertices);
    for (const std::uint32_t v : rim.vertices) rim.middle += positions_[v];
    rim.middle /= static_cast<double>(rim.vertices.size());
    const std::size_t first = shells_.triangles.size();
    Fill(rim.vertices);
    for (std::size_t t = first; t < shells_.triangles.size(); ++t) {
      rim.area_vector += mesh::AreaVector(positions_, shells_.triangles[t]);
    }
    shells_.shell_of_triangle.resize(shells_.triangles.size(), rim.shell);
    shells_.rims.push_back(std::move(rim));
  }

  void Fill(const std::vector<std::uint32_t>& rim) {
    const std::size_t corners = std::min(rim.size(), kMostCorners);
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = 0; i < corners; ++i) {
      const std::size_t begin = i * rim.size() / corners;
      const std::size_t end = (i + 1) * rim.size() / corners;
      chosen.push_back(rim[begin]);
      for (std::size_t k = begin + 1; k < end; ++k) {
        Add({rim[begin], rim[k], rim[(k + 1) % rim.size()]});
      }
    }
    if (const auto filling = FillingOf(chosen)) {
      for (const mesh::Triangle& t : *filling) Add({chosen[t[0]], chosen[t[1]], chosen[t[2]]});
      return;
    }
    for (std::size_t i = 1; i + 1 < chosen.size(); ++i) Add({chosen[0], chosen[i], chosen[i + 1]});
  }

  std::optional<std::vector<mesh::Triangle>> FillingOf(const std::vector<std::uint32_t>& corners) {
    const std::size_t steps = corners.size() * corners.size() * corners.size() / 6;
    if (corners.size() < 4 || steps > steps_left_) return std::nullopt;
    steps_left_ -= steps;
    std::vector<Eigen::Vector3d> points;
    for (const std::uint32_t v : corners) points.push_back(positions_[v]);
    return mesh::FillBySmallestArea(points, [](std::uint32_t, std::uint32_t) { return true; });
  }

  void Add(const mesh::Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) shells_.triangles.push_back(t);
  }

  void TurnOutward() {
    // From the shell's own first corner, which keeps digits far from the origin.
    std::vector<std::uint32_t> origin(shells_.volumes.size(), 0xFFFFFFFFu);
    for (std::size_t t = 0; t < shells_.triangles.size(); ++t) {
      const mesh::Triangle& corners = shells_.triangles[t];
      const std::uint32_t shell = shells_.shell_of_triangle[t];
      if (origin[shell] == 0xFFFFFFFFu) origin[shell] = corners[0];
      const Eigen::Vector3d a = positions_[corners[0]] - positions_[origin[shell]];
      const Eigen::Vector3d area = mesh::AreaVector(positions_, corners);
      shells_.volumes[shell] += a.dot(area) / 3.0;
      shells_.areas[shell] += area.norm();
    }
    for (std::size_t t = 0; t < shells_.triangles.size(); ++t) {
      if (shells_.volumes[shells_.shell_of_triangle[t]] >= 0.0) continue;
      std::swap(shells_.triangles[t][1], shells_.triangles[t][2]);
    }
    for (Rim& rim : shells_.rims) {
      if (shells_.volumes[rim.shell] >= 0.0) continue;
      rim.area_vector = -rim.area_vector;
      std::reverse(rim.vertices.begin(), rim.vertices.end());
    }
    for (double& volume : shells_.volumes) volume = std::abs(volume);
  }

  std::span<const Eigen::Vector3d> positions_;
  Shells& shells_;
  std::size_t steps_left_ = kMostSteps;
};

}  // namespace

Shells FindShells(std::span<const Eigen::Vector3d> positions, std::vector<mesh::Triangle> triangles,
                  double weld_tolerance, const ThreadPool& pool, const FitObserver& observer) {
  mesh::EdgeMates mates = mesh::FindEdgeMates(triangles, positions.size(), pool);
  mesh::JoinedTriangles joined = mesh::JoinTriangles(positions, std::move(triangles),
                                                     std::move(mates), weld_tolerance, observer);
  Shells shells;
  if (!observer.IsCancelled()) ShellFinder(positions, shells).Run(std::move(joined));
  return shells;
}

}  // namespace capfit::solid
