#include "core/mesh/prepare_mesh.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {
namespace {

absl::Status CheckPositions(const PolygonSoup& soup) {
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    if (!soup.positions[i].allFinite()) {
      return InvalidField(absl::StrCat("positions[", i, "]"), "must be finite");
    }
  }
  return absl::OkStatus();
}

absl::Status CheckSizes(const PolygonSoup& soup) {
  if (soup.face_sizes.empty()) {
    return soup.face_vertices.size() % 3 == 0
               ? absl::OkStatus()
               : InvalidField("triangle_indices", "must have three entries for each triangle");
  }
  std::size_t corners = 0;
  for (const std::uint32_t size : soup.face_sizes) corners += size;
  return corners == soup.face_vertices.size()
             ? absl::OkStatus()
             : InvalidField("face_sizes", "must add up to the number of face_vertices");
}

absl::Status CheckIndices(const PolygonSoup& soup) {
  for (std::size_t i = 0; i < soup.face_vertices.size(); ++i) {
    if (soup.face_vertices[i] >= soup.positions.size()) {
      return InvalidField(
          absl::StrCat("triangle_indices[", i, "]"),
          absl::StrCat("is ", soup.face_vertices[i], ", must be below ", soup.positions.size()));
    }
  }
  return absl::OkStatus();
}

std::vector<Triangle> Triangulate(const PolygonSoup& soup) {
  std::vector<Triangle> triangles;
  triangles.reserve(soup.face_vertices.size() / 3);
  const auto& v = soup.face_vertices;
  if (soup.face_sizes.empty()) {
    for (std::size_t i = 0; i + 2 < v.size(); i += 3)
      triangles.push_back({v[i], v[i + 1], v[i + 2]});
    return triangles;
  }
  std::size_t first = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    for (std::uint32_t k = 2; k < size; ++k) {
      triangles.push_back({v[first], v[first + k - 1], v[first + k]});
    }
    first += size;
  }
  return triangles;
}

}  // namespace

absl::StatusOr<PreparedMesh> PrepareMesh(const PolygonSoup& soup, const MeshLimits&) {
  CAPFIT_RETURN_IF_ERROR(CheckSizes(soup));
  CAPFIT_RETURN_IF_ERROR(CheckPositions(soup));
  CAPFIT_RETURN_IF_ERROR(CheckIndices(soup));
  if (soup.face_vertices.empty()) return InvalidField("mesh", "has no faces");
  std::vector<Triangle> triangles = Triangulate(soup);
  if (!FindEdgeMates(triangles, soup.positions.size()).IsClosedAndOriented()) {
    return CannotFit("NOT_CLOSED", "the surface is not closed and consistently oriented");
  }
  std::vector<std::int32_t> vertex_of_source(soup.positions.size());
  for (std::size_t i = 0; i < vertex_of_source.size(); ++i) {
    vertex_of_source[i] = static_cast<std::int32_t>(i);
  }
  return PreparedMesh{BodyMesh(soup.positions, std::move(triangles), std::move(vertex_of_source)),
                      {}};
}

}  // namespace capfit::mesh
