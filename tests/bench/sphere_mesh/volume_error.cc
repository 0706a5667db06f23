#include "tests/bench/sphere_mesh/volume_error.h"

#include "core/geometry/tapered_capsule.h"

namespace capfit::bench {
namespace {

// Of the body's diagonal: how deep the furrows between the capsules for a triangle may be.
constexpr double kRelativeSag = 5e-4;

std::vector<geometry::TaperedCapsule> Solids(const SphereMesh& mesh) {
  std::vector<geometry::TaperedCapsule> solids;
  for (const auto& [a, b] : mesh.edges) {
    solids.emplace_back(mesh.spheres[a], mesh.spheres[b]);
  }
  if (solids.empty()) {
    for (const geometry::Sphere& sphere : mesh.spheres) solids.emplace_back(sphere, sphere);
  }
  return solids;
}

}  // namespace

VolumeError::VolumeError(const mesh::BodyMesh& mesh, int columns)
    : sag_(kRelativeSag * mesh.diagonal()) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.1 * mesh.diagonal());
  grid_ = metrics::MakeColumnGrid({mesh.box_min() - margin, mesh.box_max() + margin}, columns);
  metrics::FittedSurface surface;
  surface.points_m.own().assign(mesh.vertices().begin(), mesh.vertices().end());
  surface.triangles.own().assign(mesh.triangles().begin(), mesh.triangles().end());
  surface.parts.resize(surface.triangles.size());
  surface.skin_end = surface.triangles.size();
  const metrics::BodyRows rows(surface, grid_, ThreadPool(1));
  for (std::size_t row = 0; row < grid_.y.size(); ++row) {
    body_rows_.push_back(rows.Cut(row).body);
    body_length_ += body_rows_.back().Length();
  }
}

double VolumeError::Of(const SphereMesh& mesh) const {
  const std::vector<geometry::TaperedCapsule> solids = Solids(WithoutTriangles(mesh, sag_));
  const metrics::SolidRows rows(solids, grid_);
  double off = 0.0;
  for (std::size_t row = 0; row < grid_.y.size(); ++row) {
    const metrics::RowIntervals set = rows.Cut(row);
    off += set.Length() + body_rows_[row].Length();
    for (std::size_t i = 0; i < grid_.x.size(); ++i) {
      off -= 2.0 * metrics::CommonLength(set.Column(i), body_rows_[row].Column(i));
    }
  }
  return off / body_length_;
}

}  // namespace capfit::bench
