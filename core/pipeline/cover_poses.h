// Enclosing a body in the poses of a motion as well.
#ifndef CAPFIT_CORE_PIPELINE_COVER_POSES_H_
#define CAPFIT_CORE_PIPELINE_COVER_POSES_H_

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/formats/polygon_soup.h"
#include "core/motion/cover_motion.h"
#include "core/pipeline/fit.h"
#include "core/tighten/cover_target.h"

namespace capfit::pipeline {

// The body at rest, what of it has to be inside, and the caller's mesh that it was found in.
struct BodyAtRest {
  const body::Body& body;
  const tighten::CoverTarget& target;
  const formats::PolygonSoup& soup;
};

// Encloses all frames of options.motion, which must be there and checked, with the centres where
// the weights of options.skinning carry them (sparse ones in place of dense). `max_gap_m`: proved
// at rest, of the set as it is then. Costs as motion::CoverMotion does, and the binding.
[[nodiscard]] motion::MotionReport CoverPoses(const BodyAtRest& rest, const FitOptions& options,
                                              const ThreadPool& pool, FitObserver& observer,
                                              capsule::PrimitiveSet& set, double& max_gap_m);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_COVER_POSES_H_
