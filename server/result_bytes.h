// How much memory a result takes.
#ifndef CAPFIT_SERVER_RESULT_BYTES_H_
#define CAPFIT_SERVER_RESULT_BYTES_H_

#include <cstdint>

#include "core/pipeline/fit.h"

namespace capfit::server {

// What a result holds in its large parts: weights, gaps, exported files, polygons; the rest is
// rounded up to 256 KiB. O(polygons + spheres).
[[nodiscard]] std::int64_t ResultBytes(const pipeline::FitResult& result);

// The same before the fit, for a mesh of that many vertices and bytes: a guess, which is wrong
// mostly where a budget is given as an error.
[[nodiscard]] std::int64_t ExpectedResultBytes(const pipeline::FitOptions& options,
                                               std::int64_t vertices, std::int64_t mesh_bytes);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_RESULT_BYTES_H_
