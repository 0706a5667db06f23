// What is said of a body whose surface cuts through itself.
#ifndef CAPFIT_CORE_PIPELINE_OVERLAP_WARNING_H_
#define CAPFIT_CORE_PIPELINE_OVERLAP_WARNING_H_

#include <optional>

#include "core/base/warning.h"
#include "core/body/body.h"
#include "core/metrics/column_grid.h"

namespace capfit::pipeline {

// SURFACE_OVERLAPS where the body's mesh encloses more than a thousandth of its volume twice: how
// much, and around which place of the caller's frame. `overlap` is measured in the body's own, so
// that all turned copies of a body get the same answer.
[[nodiscard]] std::optional<Warning> WarningOfOverlap(const body::Body& body,
                                                      const metrics::Overlap& overlap);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_OVERLAP_WARNING_H_
