// The growing step of the paper (III-D), with the least growth that keeps its promise.
#ifndef CAPFIT_CORE_COVERAGE_GROW_H_
#define CAPFIT_CORE_COVERAGE_GROW_H_

#include <Eigen/Core>
#include <span>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/capsule/primitive_set.h"

namespace capfit::coverage {

// A point and how far outside it may stay (negative: how deep inside it must be).
struct Demand {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  double allowed_m = 0.0;
};

// Makes the sphere or capsule that is nearest to the demand contain its point: the ends that the
// point's foot lies between grow by D/2 and move by D/2 along the surface normal, D being what is
// missing. (The paper moves them across the axis, which on a taper does not reach the point.) The
// new solid contains the old one. Spheres on the mid-plane stay there and images stay images, for
// which the growth may have to be more, up to D. Returns false where the demand holds already.
bool GrowTo(const Demand& demand, capsule::PrimitiveSet& set);

// Grows until all demands hold, the furthest out first. Every step satisfies one more and breaks
// none, so it ends after at most demands.size() steps; with cancellation, earlier. Returns how many
// steps it took. O(demands + steps * open demands * touched solids).
int GrowToAll(std::span<const Demand> demands, const FitObserver& observer,
              capsule::PrimitiveSet& set);

}  // namespace capfit::coverage

#endif  // CAPFIT_CORE_COVERAGE_GROW_H_
