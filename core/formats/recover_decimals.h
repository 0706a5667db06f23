// Decimals that a file of 32-bit floats has rounded.
#ifndef CAPFIT_CORE_FORMATS_RECOVER_DECIMALS_H_
#define CAPFIT_CORE_FORMATS_RECOVER_DECIMALS_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"

namespace capfit::formats {

// Most meshes were decimals once: a text file with five digits behind the point, converted to PLY,
// STL or GLB, comes as the floats nearest to them. Where every coordinate lies within the rounding
// of a float (plus `tolerance`, for what a transform has added) of a multiple of one power of ten,
// and chance cannot explain that, the multiples are what was meant; they are the very doubles that
// reading the text gives. So a converted mesh gives the same fit to the last bit, and no vertex
// moves by more than its file's own rounding.
//
// Returns the decimals, or nothing where the positions are none. They must be finite. O(n), and
// next to nothing for positions that are no decimals.
[[nodiscard]] std::vector<Eigen::Vector3d> RecoverDecimals(
    std::span<const Eigen::Vector3d> positions, double tolerance = 0.0);

// The same where each coordinate is exactly a float, else nothing: doubles are left as they are.
[[nodiscard]] std::vector<Eigen::Vector3d> RecoverDecimalsOfFloats(
    std::span<const Eigen::Vector3d> positions, const ThreadPool& pool = ThreadPool(1));

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_RECOVER_DECIMALS_H_
