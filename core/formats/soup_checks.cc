#include "core/formats/soup_checks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/chunk_sums.h"
#include "core/base/status.h"

namespace capfit::formats {
namespace {

absl::Status CheckLimits(const PolygonSoup& soup, const MeshLimits& limits) {
  const bool is_file = soup.is_from_file;
  const std::string vertices = is_file ? "mesh.file" : "mesh.arrays.positions";
  const std::string faces = is_file                   ? "mesh.file"
                            : soup.face_sizes.empty() ? "mesh.arrays.triangle_indices"
                                                      : "mesh.arrays.face_sizes";
  if (soup.positions.empty()) {
    return InvalidField(ErrorReason::kMissing, vertices,
                        is_file ? "has no vertices" : "is empty: the mesh has no vertices");
  }
  if (soup.face_sizes.empty() && soup.face_vertices.empty()) {
    return InvalidField(ErrorReason::kMissing, faces,
                        is_file ? "has no faces" : "is empty: the mesh has no faces");
  }
  if (soup.positions.size() > limits.max_vertices) {
    return TooLarge(vertices, soup.positions.size(), "vertices", limits.max_vertices);
  }
  if (soup.face_count() > limits.max_faces) {
    return TooLarge(faces, soup.face_count(), "faces", limits.max_faces);
  }
  return absl::OkStatus();
}

absl::Status CheckFaceSizes(const PolygonSoup& soup, const MeshLimits& limits) {
  if (soup.face_sizes.empty()) {
    if (soup.face_vertices.size() % 3 == 0) return absl::OkStatus();
    return InvalidField(
        ErrorReason::kCountMismatch, "mesh.arrays.triangle_indices",
        absl::StrCat("has ", soup.face_vertices.size(), " entries, must have 3 per triangle"),
        {{"value", absl::StrCat(soup.face_vertices.size())}, {"limit", "a multiple of 3"}});
  }
  const std::size_t faces = soup.face_sizes.size();
  if (soup.HasTrianglesOnly() && faces <= limits.max_triangles() &&
      limits.max_corners_per_face >= 3 && soup.face_vertices.size() == 3 * faces) {
    return absl::OkStatus();
  }
  const std::size_t fewest_corners = soup.is_from_file ? 0 : 3;
  TriangleCounter triangles(limits);
  std::size_t corners = 0;
  for (std::size_t f = 0; f < soup.face_sizes.size(); ++f) {
    const std::size_t size = soup.face_sizes[f];
    if (size < fewest_corners || size > limits.max_corners_per_face) {
      return OutOfRange(absl::StrCat("mesh.arrays.face_sizes[", f, "]"), size, fewest_corners,
                        limits.max_corners_per_face);
    }
    if (!triangles.Add(size)) {
      return InvalidField(ErrorReason::kTooLarge, "mesh.arrays.face_sizes",
                          TooManyTriangles(limits),
                          {{"limit", absl::StrCat(limits.max_triangles())}});
    }
    corners += size;
  }
  if (corners == soup.face_vertices.size()) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kCountMismatch, "mesh.arrays.face_sizes",
      absl::StrCat("adds up to ", corners, ", must add up to the ", soup.face_vertices.size(),
                   " face corners"),
      {{"value", absl::StrCat(corners)}, {"limit", absl::StrCat(soup.face_vertices.size())}});
}

absl::Status CheckPositions(const PolygonSoup& soup, const ThreadPool& pool) {
  // Loops without an exit, which vectorise, tell that all is well.
  const auto bad_chunk = [&](std::size_t begin, std::size_t end) {
    bool all_are = true;
    for (std::size_t i = begin; i < end; ++i) all_are &= IsPosition(soup.positions[i]);
    return std::size_t{all_are ? 0u : 1u};
  };
  if (SumOverChunks(pool, soup.positions.size(), std::size_t{0}, bad_chunk) == 0) {
    return absl::OkStatus();
  }
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    const Eigen::Vector3d& position = soup.positions[i];
    if (IsPosition(position)) continue;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (IsCoordinate(position[axis])) continue;
      const CoordinateProblem problem = ProblemOf(position[axis]);
      return InvalidField(problem.reason, absl::StrCat("mesh.arrays.positions[", 3 * i + axis, "]"),
                          problem.text, problem.facts);
    }
  }
  return absl::OkStatus();
}

absl::Status CheckIndices(const PolygonSoup& soup, const ThreadPool& pool) {
  const std::size_t count = soup.positions.size();
  const auto bad_chunk = [&](std::size_t begin, std::size_t end) {
    std::uint32_t largest = 0;
    for (std::size_t i = begin; i < end; ++i) largest = std::max(largest, soup.face_vertices[i]);
    return std::size_t{largest < count ? 0u : 1u};
  };
  if (SumOverChunks(pool, soup.face_vertices.size(), std::size_t{0}, bad_chunk) == 0) {
    return absl::OkStatus();
  }
  for (std::size_t i = 0; i < soup.face_vertices.size(); ++i) {
    if (soup.face_vertices[i] < count) continue;
    const char* const field = soup.face_sizes.empty() ? "triangle_indices" : "face_indices";
    return IndexOutOfRange(absl::StrCat("mesh.arrays.", field, "[", i, "]"), soup.face_vertices[i],
                           count);
  }
  return absl::OkStatus();
}

}  // namespace

std::string CoordinateRange() {
  return absl::StrCat("[", -kLargestCoordinate, ", ", kLargestCoordinate, "]");
}

CoordinateProblem ProblemOf(double value) {
  const std::string text = absl::StrCat(value);
  if (!std::isfinite(value)) {
    return {ErrorReason::kNotFinite,
            absl::StrCat("is ", text, ", must be finite"),
            {{"value", text}, {"limit", "finite"}}};
  }
  return {ErrorReason::kOutOfRange,
          absl::StrCat("is ", text, ", must be in ", CoordinateRange()),
          {{"value", text}, {"limit", CoordinateRange()}}};
}

std::string TooManyTriangles(const MeshLimits& limits) {
  return absl::StrCat("come to too many triangles: faces of n corners make n - 2 each, must be at ",
                      "most ", limits.max_triangles(), " together");
}

absl::Status CheckSoup(const PolygonSoup& soup, const MeshLimits& limits, const ThreadPool& pool) {
  CAPFIT_RETURN_IF_ERROR(CheckLimits(soup, limits));
  CAPFIT_RETURN_IF_ERROR(CheckFaceSizes(soup, limits));
  absl::Status positions;
  absl::Status indices;
  pool.ForEach(2, [&](std::size_t half) {
    if (half == 0) positions = CheckPositions(soup, pool);
    if (half == 1) indices = CheckIndices(soup, pool);
  });
  return positions.ok() ? indices : positions;
}

}  // namespace capfit::formats
