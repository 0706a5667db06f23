// A result as what exports take.
#ifndef CAPFIT_CORE_PIPELINE_COLLIDERS_H_
#define CAPFIT_CORE_PIPELINE_COLLIDERS_H_

#include <cstddef>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "core/export/collider_set.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {

// `source`: the name of the mesh's file without folder and ending, or empty.
[[nodiscard]] exports::ColliderSet CollidersOf(const FitResult& result, std::string source);

// Before a fit: INVALID_ARGUMENT names the wish ("exports[1].format") that needs a GLB to put the
// colliders into, where `original` is none. `original`: the bytes of the mesh's file, or empty
// where it came as arrays.
[[nodiscard]] absl::Status CheckExports(std::span<const ExportWish> wishes,
                                        std::span<const std::byte> original);

// Makes the files that the options asked for. Warnings of a format begin with its name.
// INVALID_ARGUMENT names the wish.
[[nodiscard]] absl::Status AddExports(std::span<const ExportWish> wishes,
                                      std::span<const std::byte> original,
                                      const std::string& source, FitResult& result);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_COLLIDERS_H_
