// A result as what exports take.
#ifndef CAPFIT_CORE_PIPELINE_COLLIDERS_H_
#define CAPFIT_CORE_PIPELINE_COLLIDERS_H_

#include <string>

#include "core/export/collider_set.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {

// `source`: the name of the mesh's file without folder and ending, or empty.
[[nodiscard]] exports::ColliderSet CollidersOf(const FitResult& result, std::string source);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_COLLIDERS_H_
