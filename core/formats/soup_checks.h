// Whether coordinates, faces and whole arrays make sense as a mesh at all.
#ifndef CAPFIT_CORE_FORMATS_SOUP_CHECKS_H_
#define CAPFIT_CORE_FORMATS_SOUP_CHECKS_H_

#include <cmath>
#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "core/base/status.h"
#include "core/base/thread_pool.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// Beyond this, in any unit, a double keeps too few digits for a body, and products overflow.
inline constexpr double kLargestCoordinate = 1e12;

// Finite and within kLargestCoordinate of the origin.
[[nodiscard]] inline bool IsCoordinate(double value) {
  return std::abs(value) <= kLargestCoordinate;  // false for NaN too
}

// All three of anything that has three.
template <typename Point>
[[nodiscard]] bool IsPosition(const Point& point) {
  bool is_position = true;
  for (int axis = 0; axis < 3; ++axis) is_position &= IsCoordinate(point[axis]);
  return is_position;
}

// "[-1e+12, 1e+12]".
[[nodiscard]] std::string CoordinateRange();

// Why IsCoordinate(value) does not hold.
struct CoordinateProblem {
  ErrorReason reason;
  std::string text;  // "is nan, must be finite"
  ErrorFacts facts;
};
[[nodiscard]] CoordinateProblem ProblemOf(double value);

// Counts the triangles that faces will become while they are read: what a file asks for is refused
// before it takes memory.
class TriangleCounter {
 public:
  explicit TriangleCounter(const MeshLimits& limits) : left_(limits.max_triangles()) {}

  // A face of that many corners. False where it is one too many.
  [[nodiscard]] bool Add(std::size_t corners) {
    const std::size_t triangles = corners < 3 ? 0 : corners - 2;
    if (triangles > left_) return false;
    left_ -= triangles;
    return true;
  }

 private:
  std::size_t left_;
};

// What to say where a TriangleCounter has had enough.
[[nodiscard]] std::string TooManyTriangles(const MeshLimits& limits);

// Sizes within `limits` and consistent, faces of three corners or more (of any number in a file),
// coordinates, indices in range. INVALID_ARGUMENT names the first offender in the caller's arrays:
// "mesh.arrays.positions[22] is nan, must be finite". (Readers refuse such things themselves, for
// they know the line; of a file only its size is left to be said here.) O(n), in parallel.
[[nodiscard]] absl::Status CheckSoup(const PolygonSoup& soup, const MeshLimits& limits,
                                     const ThreadPool& pool = ThreadPool(1));

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_SOUP_CHECKS_H_
