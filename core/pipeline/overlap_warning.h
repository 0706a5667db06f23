// What is said of a body whose surface cuts through itself.
#ifndef CAPFIT_CORE_PIPELINE_OVERLAP_WARNING_H_
#define CAPFIT_CORE_PIPELINE_OVERLAP_WARNING_H_

#include <optional>

#include "core/base/warning.h"
#include "core/body/body.h"

namespace capfit::pipeline {

// SURFACE_OVERLAPS where the mesh encloses more than a thousandth of its volume twice: how much,
// and around which place of the caller's frame. Measured in the body's own frame, so that all
// turned copies of a body get the same answer. As long as mesh::MeasureOverlap takes, on one
// thread.
[[nodiscard]] std::optional<Warning> WarningOfOverlap(const body::Body& body);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_OVERLAP_WARNING_H_
