#include "core/mesh/triangulate_faces.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "core/mesh/triangulate_loop.h"

namespace capfit::mesh {
namespace {

// Steps of the search for the least area (n^3 / 6 for a face of n corners, some nanoseconds each)
// that one mesh may take: a million hexagons. What is beyond gets fans.
constexpr std::size_t kMostSteps = 40'000'000;

class FaceTriangulator {
 public:
  explicit FaceTriangulator(const PolygonSoup& soup) : soup_(soup) {
    result_.triangles.reserve(soup.face_vertices.size() / 3);
  }

  TriangulatedFaces Run() {
    const std::span<const std::uint32_t> corners = soup_.face_vertices;
    if (soup_.face_sizes.empty()) {
      for (std::size_t i = 0; i < corners.size(); i += 3) AddFan(corners.subspan(i, 3));
    }
    std::size_t first = 0;
    for (const std::uint32_t size : soup_.face_sizes) {
      AddFace(corners.subspan(first, size));
      first += size;
    }
    return std::move(result_);
  }

 private:
  void AddFace(std::span<const std::uint32_t> face) {
    const std::size_t steps = face.size() * face.size() * face.size() / 6;
    if (face.size() <= 4 || steps > steps_left_) {
      AddFan(face);
    } else {
      steps_left_ -= steps;
      AddSmallest(face);
    }
  }

  void AddFan(std::span<const std::uint32_t> face) {
    if (face.size() < 3) ++result_.degenerate;
    for (std::size_t k = 2; k < face.size(); ++k) Add({face[0], face[k - 1], face[k]});
  }

  void AddSmallest(std::span<const std::uint32_t> face) {
    points_.clear();
    for (const std::uint32_t v : face) points_.push_back(soup_.positions[v]);
    const auto any = [](std::uint32_t, std::uint32_t) { return true; };
    const std::optional<std::vector<Triangle>> filling = FillBySmallestArea(points_, any);
    for (const Triangle& t : *filling) Add({face[t[0]], face[t[1]], face[t[2]]});
  }

  void Add(const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      ++result_.degenerate;
    } else {
      result_.triangles.push_back(t);
    }
  }

  const PolygonSoup& soup_;
  TriangulatedFaces result_;
  std::vector<Eigen::Vector3d> points_;
  std::size_t steps_left_ = kMostSteps;
};

}  // namespace

TriangulatedFaces TriangulateFaces(const PolygonSoup& soup) { return FaceTriangulator(soup).Run(); }

}  // namespace capfit::mesh
