// What carries the spheres of a fitted set when the body moves.
#ifndef CAPFIT_CORE_PIPELINE_BIND_SPHERES_H_
#define CAPFIT_CORE_PIPELINE_BIND_SPHERES_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/formats/polygon_soup.h"
#include "core/pipeline/fit.h"
#include "core/skinning/sparse_weights.h"

namespace capfit::pipeline {

// Whether joints hold vertices of the mesh.
[[nodiscard]] bool HasRig(const formats::PolygonSoup& soup);

[[nodiscard]] std::vector<Eigen::Vector3d> CentersOf(const capsule::PrimitiveSet& set);

// Few weights for each sphere. `centers_m` in the body frame.
[[nodiscard]] skinning::SparseWeights BindSparse(const body::Body& body,
                                                 std::span<const Eigen::Vector3d> centers_m,
                                                 const ThreadPool& pool,
                                                 const FitObserver& observer);

// Fills the result's weights, and its joints where the mesh has a rig: for each sphere and capsule
// the one that follows it best, and how far the sphere then drifts. `set` is in the body frame; the
// result's primitives are the same in the caller's.
void BindSpheres(const formats::PolygonSoup& soup, const body::Body& body,
                 const capsule::PrimitiveSet& set, SkinningMode mode, const ThreadPool& pool,
                 const FitObserver& observer, FitResult& result);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_BIND_SPHERES_H_
