#include "core/circle/error_curve.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>

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
  std::atomic<bool> is_known = false;
  PolygonApproximation approximation;
};

ErrorCurves::ErrorCurves(std::span<const section::FeaturePolygon> polygons, int max_circles,
                         const CircleOptions& options, const ThreadPool& pool,
                         const FitObserver& observer)
    : polygons_(polygons),
      max_circles_(std::max(1, max_circles)),
      options_(options),
      pool_(pool),
      observer_(observer),
      entries_(new Entry[polygons.size() * max_circles_]),
      asked_(new std::atomic<int>[polygons.size()]) {}

ErrorCurves::~ErrorCurves() = default;

ErrorCurves::Entry& ErrorCurves::EntryOf(int polygon_index, int circle_count) const {
  return entries_[polygon_index * max_circles_ + std::clamp(circle_count, 1, max_circles_) - 1];
}

const PolygonApproximation& ErrorCurves::Compute(int polygon_index, int circle_count) const {
  const int count = std::clamp(circle_count, 1, max_circles_);
  Entry& entry = EntryOf(polygon_index, count);
  std::call_once(entry.once, [&] {
    const section::FeaturePolygon& polygon = polygons_[polygon_index];
    if (polygon.mirror >= 0 && polygon.mirror < polygon_index) {
      entry.approximation = Mirrored(Compute(polygon.mirror, count));
    } else {
      CircleOptions options = options_;
      options.symmetric = polygon.mirror == polygon_index;
      options.seed = options_.seed + polygon_index * 1024 + count;
      entry.approximation = ApproximatePolygon(polygon, count, options, observer_);
    }
    entry.is_known = true;
  });
  return entry.approximation;
}

// Who asks for one polygon will soon ask for those that have been asked for nearly as often.
void ErrorCurves::ComputeTogether(int polygon_index, int circle_count) const {
  const auto source = [this](int i) {  // what the polygon's circles follow from
    const int mirror = polygons_[i].mirror;
    return mirror >= 0 ? std::min(i, mirror) : i;
  };
  std::atomic<int>& asked = asked_[source(polygon_index)];
  asked = std::max(asked.load(), circle_count);
  if (EntryOf(polygon_index, circle_count).is_known) return;
  pool_.ForEach(polygons_.size(), [&](int i) {
    if (source(i) == i && asked_[i] >= circle_count - 1) (void)Compute(i, circle_count);
  });
}

const PolygonApproximation& ErrorCurves::Approximation(int polygon_index, int circle_count) const {
  return Compute(polygon_index, circle_count);
}

double ErrorCurves::BestAreaM2(int polygon_index, int circle_count) const {
  double least = Compute(polygon_index, 1).outside_area_m2;
  for (int count = 2; count <= std::min(circle_count, max_circles_); ++count) {
    ComputeTogether(polygon_index, count);
    least = std::min(least, Compute(polygon_index, count).outside_area_m2);
  }
  return least;
}

void ErrorCurves::Prepare(int circle_count) const {
  const std::size_t counts = std::clamp(circle_count, 1, max_circles_);
  // The largest counts take longest, so they start first.
  pool_.ForEach(polygons_.size() * counts, [&](std::size_t job) {
    const auto polygon = static_cast<int>(job % polygons_.size());
    const int mirror = polygons_[polygon].mirror;
    if (mirror >= 0 && mirror < polygon) return;  // follows from its image
    (void)Compute(polygon, static_cast<int>(counts - job / polygons_.size()));
  });
}

void ErrorCurves::Prepare(std::span<const int> circle_counts) const {
  // The largest counts take longest here too.
  std::vector<int> order(circle_counts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return circle_counts[a] > circle_counts[b]; });
  pool_.ForEach(order.size(),
                [&](std::size_t i) { (void)Compute(order[i], circle_counts[order[i]]); });
}

}  // namespace capfit::circle
