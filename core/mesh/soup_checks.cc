#include "core/mesh/soup_checks.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::mesh {
namespace {

// Beyond this, in any unit, a double keeps too few digits for a body, and products overflow.
constexpr double kLargestCoordinate = 1e12;

absl::Status CheckLimits(const PolygonSoup& soup, const MeshLimits& limits) {
  if (soup.positions.empty()) {
    return InvalidField(ErrorReason::kMissing, "mesh.arrays.positions",
                        "is empty: the mesh has no vertices");
  }
  if (soup.face_vertices.empty()) {
    return InvalidField(ErrorReason::kMissing, "mesh.arrays.triangle_indices",
                        "is empty: the mesh has no faces");
  }
  if (soup.positions.size() > limits.max_vertices) {
    return TooLarge("mesh.arrays.positions", soup.positions.size(), "vertices",
                    limits.max_vertices);
  }
  if (soup.face_count() > limits.max_faces) {
    return TooLarge("mesh.arrays.triangle_indices", soup.face_count(), "faces", limits.max_faces);
  }
  return absl::OkStatus();
}

absl::Status CheckFaceSizes(const PolygonSoup& soup, const MeshLimits& limits) {
  if (soup.face_sizes.empty()) {
    if (soup.face_vertices.size() % 3 == 0) return absl::OkStatus();
    return InvalidField(
        ErrorReason::kCountMismatch, "mesh.arrays.triangle_indices",
        absl::StrCat("has ", soup.face_vertices.size(), " entries, must have 3 per triangle"));
  }
  TriangleCounter triangles(limits);
  std::size_t corners = 0;
  for (std::size_t f = 0; f < soup.face_sizes.size(); ++f) {
    if (soup.face_sizes[f] > limits.max_corners_per_face) {
      return OutOfRange(absl::StrCat("mesh.arrays.face_sizes[", f, "]"),
                        std::size_t{soup.face_sizes[f]}, std::size_t{3},
                        limits.max_corners_per_face);
    }
    if (!triangles.Add(soup.face_sizes[f])) {
      return InvalidField(ErrorReason::kTooLarge, "mesh.arrays.face_sizes",
                          TooManyTriangles(limits));
    }
    corners += soup.face_sizes[f];
  }
  if (corners == soup.face_vertices.size()) return absl::OkStatus();
  return InvalidField(ErrorReason::kCountMismatch, "mesh.arrays.face_sizes",
                      absl::StrCat("adds up to ", corners, ", must add up to the ",
                                   soup.face_vertices.size(), " face corners"));
}

absl::Status CheckPositions(const PolygonSoup& soup) {
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    // Also false for NaN.
    if (soup.positions[i].cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kLargestCoordinate) {
      continue;
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double value = soup.positions[i][axis];
      if (std::abs(value) <= kLargestCoordinate) continue;
      const std::string field = absl::StrCat("mesh.arrays.positions[", 3 * i + axis, "]");
      if (std::isfinite(value)) {
        return OutOfRange(field, value, -kLargestCoordinate, kLargestCoordinate);
      }
      return InvalidField(ErrorReason::kNotFinite, field,
                          absl::StrCat("is ", value, ", must be finite"),
                          {{"value", absl::StrCat(value)}, {"limit", "finite"}});
    }
  }
  return absl::OkStatus();
}

absl::Status CheckIndices(const PolygonSoup& soup) {
  const std::size_t count = soup.positions.size();
  for (std::size_t i = 0; i < soup.face_vertices.size(); ++i) {
    if (soup.face_vertices[i] < count) continue;
    const char* const field = soup.face_sizes.empty() ? "triangle_indices" : "face_indices";
    return IndexOutOfRange(absl::StrCat("mesh.arrays.", field, "[", i, "]"), soup.face_vertices[i],
                           count);
  }
  return absl::OkStatus();
}

}  // namespace

std::string TooManyTriangles(const MeshLimits& limits) {
  return absl::StrCat("come to too many triangles: faces of n corners make n - 2 each, must be at ",
                      "most ", limits.max_triangles(), " together");
}

absl::Status CheckSoup(const PolygonSoup& soup, const MeshLimits& limits) {
  CAPFIT_RETURN_IF_ERROR(CheckLimits(soup, limits));
  CAPFIT_RETURN_IF_ERROR(CheckFaceSizes(soup, limits));
  CAPFIT_RETURN_IF_ERROR(CheckPositions(soup));
  return CheckIndices(soup);
}

}  // namespace capfit::mesh
