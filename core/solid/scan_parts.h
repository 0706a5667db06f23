// What of a scan is body, what floor, what crumbs.
#ifndef CAPFIT_CORE_SOLID_SCAN_PARTS_H_
#define CAPFIT_CORE_SOLID_SCAN_PARTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/edge_mates.h"

namespace capfit::solid {

enum class ScanPart : std::uint8_t { kBody, kFloor, kFragment };

// What somebody stands on: a piece of floor, a turntable, the top of a box.
struct Floor {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();  // unit
  double margin = 0.0;  // what lies lower than this above it is cut off, where it hangs together
};

struct ScanParts {
  std::vector<ScanPart> of_triangle;
  std::optional<Floor> floor;
  std::size_t fragments = 0;  // pieces
};

// Tells the body of a scan from what was scanned with it.
//
// A floor is a wide flat sheet at one end of the longest way through the rest (or up to three
// tenths of that above the end: the top of a stand), within 15 degrees of level to an axis of the
// caller's, of which an area of 2.5 % of the square of the height lies bare: no foot is above it or
// around it. Soles never are, nor is the closed end of a long robe. Pieces that hang together with
// it are cut off a few millimetres above it (so much of joined feet is lost: a scan has no soles
// there); soles that stand on it unjoined are left alone.
//
// Fragments are pieces, apart from the largest, of less than 1 % of its area and a tenth of its
// diagonal.
//
// `triangles`: corners in range, different and finite. Close to O(n): some 20 ms for 64k triangles.
// All is body where `observer` cancels.
[[nodiscard]] ScanParts FindScanParts(std::span<const Eigen::Vector3d> positions,
                                      std::span<const mesh::Triangle> triangles,
                                      const FitObserver& observer);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_SCAN_PARTS_H_
