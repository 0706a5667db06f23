#include "client/picture/belongs.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/picture/result_body.h"
#include "core/base/status.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::client {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kSameBox = 0.02;           // of the diagonal
constexpr double kFarCentre = 0.25;         // of the diagonal
constexpr double kSmallestDiagonal = 0.12;  // of the mesh's diagonal
constexpr double kLargestDiagonal = 2.0;    // of the mesh's diagonal

// Of what a fit takes; of a mesh that it cannot take, of the vertices that faces use.
AlignedBox3d BoxOf(const formats::PolygonSoup& soup, const character::CharacterOptions& character) {
  if (const auto taken =
          UnderstandBody(soup, character, body::Unit::kAuto, body::UpAxis::kAuto, ThreadPool());
      taken.ok()) {
    return {taken->box_min, taken->box_max};
  }
  if (const auto prepared = mesh::PrepareMesh(soup); prepared.ok()) {  // no body, but a mesh
    return {prepared->mesh.box_min(), prepared->mesh.box_max()};
  }
  AlignedBox3d box;
  for (const std::uint32_t vertex : soup.face_vertices) {
    if (vertex < soup.positions.size()) box.extend(soup.positions[vertex]);
  }
  return box;
}

AlignedBox3d BoxOf(const std::vector<geometry::Sphere>& spheres) {
  AlignedBox3d box;
  for (const geometry::Sphere& sphere : spheres) {
    box.extend((sphere.center_m.array() - sphere.radius_m).matrix());
    box.extend((sphere.center_m.array() + sphere.radius_m).matrix());
  }
  return box;
}

std::string Text(const AlignedBox3d& box) {
  return absl::StrFormat("(%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g)", box.min().x(), box.min().y(),
                         box.min().z(), box.max().x(), box.max().y(), box.max().z());
}

absl::Status Stranger(const std::string& told, const AlignedBox3d& theirs, const AlignedBox3d& ours,
                      const std::string& advice) {
  const double times = ours.diagonal().norm() / theirs.diagonal().norm();
  return InvalidField(
      ErrorReason::kContradictsBody, "RESULT",
      absl::StrFormat("is not of this BODY: %s from %s, BODY reaches from %s, %.3g times as large; "
                      "%s",
                      told, Text(theirs), Text(ours), times, advice),
      {{"value", Text(ours)}, {"limit", Text(theirs)}});
}

absl::Status CheckOwn(const ResultBodyFacts& fitted, const AlignedBox3d& box) {
  const AlignedBox3d theirs(fitted.box_min, fitted.box_max);
  const double off = std::max((theirs.min() - box.min()).cwiseAbs().maxCoeff(),
                              (theirs.max() - box.max()).cwiseAbs().maxCoeff());
  if (off <= kSameBox * theirs.diagonal().norm()) return absl::OkStatus();
  return Stranger("it was fitted to a body", theirs, box,
                  "give the mesh file that was fitted, in the unit, axes and pose of the fit");
}

absl::Status CheckForeign(const std::vector<geometry::Sphere>& spheres, const AlignedBox3d& box) {
  const AlignedBox3d set = BoxOf(spheres);
  const double diagonal = box.diagonal().norm();
  const Vector3d margin = Vector3d::Constant(kFarCentre * diagonal);
  const AlignedBox3d near(box.min() - margin, box.max() + margin);
  const double ratio = set.diagonal().norm() / diagonal;
  const bool all_near = std::all_of(spheres.begin(), spheres.end(), [&](const auto& sphere) {
    return near.contains(sphere.center_m);
  });
  if (all_near && ratio >= kSmallestDiagonal && ratio <= kLargestDiagonal) return absl::OkStatus();
  return Stranger("its spheres reach", set, box,
                  "give both in the same unit and axes, of the same body");
}

}  // namespace

absl::Status CheckBelongs(const ResultSet& result, const formats::PolygonSoup& body) {
  const AlignedBox3d box = BoxOf(body, result.character);
  if (box.isEmpty()) return absl::OkStatus();  // other checks say what is wrong with it
  if (result.body) return CheckOwn(*result.body, box);
  return result.spheres.empty() ? absl::OkStatus() : CheckForeign(result.spheres, box);
}

absl::Status CheckVertexCount(const std::string& name, std::size_t vertex_count,
                              const formats::PolygonSoup& body) {
  if (vertex_count == body.positions.size()) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kContradictsBody, name,
      absl::StrCat("has ", vertex_count, " vertices, BODY has ", body.positions.size(),
                   "; give what was written with the result "
                   "of this very mesh file"),
      {{"value", absl::StrCat(vertex_count)}, {"limit", absl::StrCat(body.positions.size())}});
}

}  // namespace capfit::client
