#include "core/circle/error_curve.h"

#include <algorithm>
#include <cstddef>

namespace capfit::circle {
namespace {

PolygonApproximation Mirrored(const PolygonApproximation& approximation) {
  PolygonApproximation image;
  image.outside_area_m2 = approximation.outside_area_m2;
  // From last to first: ascending in x again.
  for (auto it = approximation.circles.rbegin(); it != approximation.circles.rend(); ++it) {
    image.circles.push_back({{-it->center_m.x(), it->center_m.y()}, it->radius_m});
  }
  return image;
}

}  // namespace

struct ErrorCurves::Entry {
  std::once_flag once;
  PolygonApproximation approximation;
};

ErrorCurves::ErrorCurves(std::span<const section::FeaturePolygon> polygons, int max_circles,
                         const CircleOptions& options, const FitObserver& observer)
    : polygons_(polygons),
      max_circles_(std::max(1, max_circles)),
      options_(options),
      observer_(observer),
      entries_(new Entry[polygons.size() * static_cast<std::size_t>(max_circles_)]) {}

ErrorCurves::~ErrorCurves() = default;

const PolygonApproximation& ErrorCurves::Compute(int polygon_index, int circle_count) const {
  const auto index = static_cast<std::size_t>(polygon_index);
  const int count = std::clamp(circle_count, 1, max_circles_);
  Entry& entry = entries_[index * static_cast<std::size_t>(max_circles_) +
                          static_cast<std::size_t>(count - 1)];
  std::call_once(entry.once, [&] {
    const section::FeaturePolygon& polygon = polygons_[index];
    if (polygon.mirror >= 0 && polygon.mirror < polygon_index) {
      entry.approximation = Mirrored(Compute(polygon.mirror, count));
      return;
    }
    CircleOptions options = options_;
    options.symmetric = polygon.mirror == polygon_index;
    options.seed = options_.seed + index * 1024 + static_cast<std::size_t>(count);
    entry.approximation = ApproximatePolygon(polygon, count, options, observer_);
  });
  return entry.approximation;
}

const PolygonApproximation& ErrorCurves::Approximation(int polygon_index, int circle_count) const {
  return Compute(polygon_index, circle_count);
}

double ErrorCurves::BestAreaM2(int polygon_index, int circle_count) const {
  double least = Compute(polygon_index, 1).outside_area_m2;
  for (int count = 2; count <= std::min(circle_count, max_circles_); ++count) {
    least = std::min(least, Compute(polygon_index, count).outside_area_m2);
  }
  return least;
}

void ErrorCurves::Prepare(int circle_count, const ThreadPool& pool) const {
  const auto counts = static_cast<std::size_t>(std::clamp(circle_count, 1, max_circles_));
  // The largest counts take longest, so they start first.
  pool.ForEach(polygons_.size() * counts, [&](std::size_t job) {
    const auto polygon = static_cast<int>(job % polygons_.size());
    if (polygons_[static_cast<std::size_t>(polygon)].mirror >= 0 &&
        polygons_[static_cast<std::size_t>(polygon)].mirror < polygon) {
      return;  // follows from its image
    }
    (void)Compute(polygon, static_cast<int>(counts - job / polygons_.size()));
  });
}

}  // namespace capfit::circle
