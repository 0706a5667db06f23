// What carries the spheres of a fitted set when the body moves.
#ifndef CAPFIT_CORE_PIPELINE_BIND_SPHERES_H_
#define CAPFIT_CORE_PIPELINE_BIND_SPHERES_H_

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/formats/polygon_soup.h"
#include "core/skinning/mean_value_coordinates.h"
#include "core/skinning/sparse_weights.h"

namespace capfit::pipeline {

// Whether joints hold vertices of the mesh.
[[nodiscard]] bool HasRig(const formats::PolygonSoup& soup);

[[nodiscard]] std::vector<Eigen::Vector3d> CentersOf(const capsule::PrimitiveSet& set);

// Nothing where the body's mesh is the surface that came.
[[nodiscard]] std::optional<skinning::Carriers> CarriersOf(const body::Body& body);

// `centers_m` in the body frame.
[[nodiscard]] skinning::SparseWeights BindSparse(const body::Body& body,
                                                 std::span<const Eigen::Vector3d> centers_m,
                                                 const ThreadPool& pool,
                                                 const FitObserver& observer);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_BIND_SPHERES_H_
