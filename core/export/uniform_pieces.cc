#include "core/export/uniform_pieces.h"

#include <algorithm>
#include <cmath>

#include "core/base/status.h"

namespace capfit::exports {
namespace {

// Engines refuse capsules of almost no length: a shorter one becomes a ball that holds it.
constexpr double kLeastLengthM = 1e-9;

int CountOfPieces(double difference_m, double max_overshoot_m) {
  return std::max(1, static_cast<int>(std::ceil(std::abs(difference_m) / max_overshoot_m - 1e-9)));
}

double Lerp(double from, double to, double t) { return from + t * (to - from); }

}  // namespace

absl::Status CheckOvershoot(double max_overshoot_m) {
  // So that NaN is refused too.
  if (max_overshoot_m >= kMinOvershootM && max_overshoot_m <= kMaxOvershootM) {
    return absl::OkStatus();
  }
  return OutOfRange("max_overshoot_m", max_overshoot_m, kMinOvershootM, kMaxOvershootM);
}

std::vector<UniformPiece> UniformPieces(const geometry::TaperedCapsule& hull,
                                        double max_overshoot_m) {
  if (hull.IsSphere()) {
    const geometry::Sphere& ball = hull.a().radius_m >= hull.b().radius_m ? hull.a() : hull.b();
    return {{ball.center_m, ball.center_m, ball.radius_m}};
  }
  const double difference_m = hull.b().radius_m - hull.a().radius_m;
  const int count = CountOfPieces(difference_m, max_overshoot_m);
  std::vector<UniformPiece> pieces;
  for (int k = 0; k < count; ++k) {
    // The hull is the union of the balls with centre and radius interpolated between its ends; this
    // piece holds those from t0 to t1, of which the last lies in a larger one that stops earlier.
    const double t0 = static_cast<double>(k) / count;
    const double t1 = static_cast<double>(k + 1) / count;
    const double step_m = std::abs(difference_m) / count;
    double from_m = t0 * hull.length_m();
    double to_m = t1 * hull.length_m();
    if (difference_m < 0.0) to_m = std::max(from_m, to_m - step_m);
    if (difference_m > 0.0) from_m = std::min(to_m, from_m + step_m);
    double radius_m = std::max(Lerp(hull.a().radius_m, hull.b().radius_m, t0),
                               Lerp(hull.a().radius_m, hull.b().radius_m, t1));
    if (to_m - from_m < kLeastLengthM) {
      radius_m += to_m - from_m;
      to_m = from_m;
    }
    pieces.push_back({hull.a().center_m + from_m * hull.axis(),
                      hull.a().center_m + to_m * hull.axis(), radius_m});
  }
  return pieces;
}

std::vector<UniformPiece> ConeCylinders(const geometry::TaperedCapsule& hull,
                                        double max_overshoot_m) {
  if (hull.IsSphere()) return {};
  const double sin = hull.sin_half_angle();
  const double cos = hull.cos_half_angle();
  const double low_m = hull.a().radius_m * sin;
  const double high_m = hull.length_m() + hull.b().radius_m * sin;
  const double low_radius_m = hull.a().radius_m * cos;
  const double high_radius_m = hull.b().radius_m * cos;
  const int count = CountOfPieces(high_radius_m - low_radius_m, max_overshoot_m);
  std::vector<UniformPiece> cylinders;
  for (int k = 0; k < count; ++k) {
    const double t0 = static_cast<double>(k) / count;
    const double t1 = static_cast<double>(k + 1) / count;
    cylinders.push_back(
        {hull.a().center_m + Lerp(low_m, high_m, t0) * hull.axis(),
         hull.a().center_m + Lerp(low_m, high_m, t1) * hull.axis(),
         std::max(Lerp(low_radius_m, high_radius_m, t0), Lerp(low_radius_m, high_radius_m, t1))});
  }
  return cylinders;
}

}  // namespace capfit::exports
