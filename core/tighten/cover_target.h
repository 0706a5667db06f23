// What has to be inside of a set.
#ifndef CAPFIT_CORE_TIGHTEN_COVER_TARGET_H_
#define CAPFIT_CORE_TIGHTEN_COVER_TARGET_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/body/body.h"

namespace capfit::tighten {

// Vertices and triangles of the fitted parts, in the body frame.
struct CoverTarget {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<mesh::Triangle> triangles;  // indices into points_m
  std::vector<body::Part> point_parts;    // which part each point belongs to
  std::vector<std::uint32_t> vertices;    // which vertex of Body::enclosed() each point is
};

// The vertices of the selected parts, and the triangles whose three corners are all among them.
[[nodiscard]] CoverTarget TargetOf(const body::Body& body, const body::PartSelection& parts);

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_COVER_TARGET_H_
