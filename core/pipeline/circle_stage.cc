#include "core/pipeline/circle_stage.h"

#include <algorithm>
#include <utility>

namespace capfit::pipeline {
namespace {

// Frames of mirrored limbs both have their x axis towards the body's left, so the mirror image of a
// circle is the same circle with x negated.
circle::PolygonApproximation MirrorImage(circle::PolygonApproximation approximation) {
  for (circle::Circle& circle : approximation.circles) circle.center_m.x() *= -1.0;
  return approximation;
}

}  // namespace

CircleStage::CircleStage(std::span<const section::FeaturePolygon> polygons, std::uint64_t seed,
                         const ThreadPool& pool, const FitObserver& observer)
    : polygons_(polygons), seed_(seed), pool_(pool), observer_(observer), fits_(polygons.size()) {}

int CircleStage::OwnerOf(int polygon) const {
  const int mirror = polygons_[static_cast<std::size_t>(polygon)].mirror;
  return mirror >= 0 ? std::min(mirror, polygon) : polygon;
}

circle::PolygonApproximation CircleStage::Fit(int owner, int circle_count) const {
  const section::FeaturePolygon& polygon = polygons_[static_cast<std::size_t>(owner)];
  circle::CircleOptions options;
  options.symmetric = polygon.mirror == owner;
  options.seed = seed_;
  return circle::ApproximatePolygon(polygon, circle_count, options, observer_);
}

std::optional<circle::PolygonApproximation>& CircleStage::Slot(int owner, int circle_count) {
  auto& fits = fits_[static_cast<std::size_t>(owner)];
  if (fits.size() < static_cast<std::size_t>(circle_count)) {
    fits.resize(static_cast<std::size_t>(circle_count));
  }
  return fits[static_cast<std::size_t>(circle_count) - 1];
}

void CircleStage::Prepare(int max_circles) {
  std::vector<std::pair<int, int>> jobs;  // (polygon, count), the dear ones first
  for (int count = max_circles; count >= 1; --count) {
    for (int i = 0; i < static_cast<int>(polygons_.size()); ++i) {
      if (OwnerOf(i) == i && !Slot(i, count).has_value()) jobs.emplace_back(i, count);
    }
  }
  std::vector<circle::PolygonApproximation> results(jobs.size());
  pool_.ForEach(jobs.size(), [&](std::size_t k) {
    if (!observer_.IsCancelled()) results[k] = Fit(jobs[k].first, jobs[k].second);
  });
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    Slot(jobs[k].first, jobs[k].second) = std::move(results[k]);
  }
}

double CircleStage::Error_m2(int polygon, int circle_count) {
  const int owner = OwnerOf(polygon);
  double error_m2 = 0.0;
  for (int count = 1; count <= circle_count; ++count) {
    auto& slot = Slot(owner, count);
    if (!slot.has_value()) slot = Fit(owner, count);
    error_m2 = count == 1 ? slot->outside_area_m2 : std::min(error_m2, slot->outside_area_m2);
  }
  return error_m2;
}

circle::PolygonApproximation CircleStage::Approximation(int polygon, int circle_count) {
  const int owner = OwnerOf(polygon);
  auto& slot = Slot(owner, circle_count);
  if (!slot.has_value()) slot = Fit(owner, circle_count);
  return owner == polygon ? *slot : MirrorImage(*slot);
}

}  // namespace capfit::pipeline
