#include "core/pipeline/overlap_warning.h"

#include "absl/strings/str_format.h"

namespace capfit::pipeline {
namespace {

// Overlap above this share of the volume is more than lips or armpits that touch.
constexpr double kTellingOverlap = 1e-3;

}  // namespace

std::optional<Warning> WarningOfOverlap(const body::Body& body, const metrics::Overlap& overlap) {
  const double share = overlap.volume_m3 / body.mesh.volume();
  if (!(share > kTellingOverlap)) return std::nullopt;
  const Eigen::Vector3d at = body.body_from_caller.Inverse().Apply(overlap.middle_m);
  return Warning{
      "SURFACE_OVERLAPS",
      absl::StrFormat("the surface cuts through itself: %.2g %% of its volume, around (%.4g, %.4g, "
                      "%.4g), is enclosed more than once",
                      100.0 * share, at.x(), at.y(), at.z()),
      0};
}

}  // namespace capfit::pipeline
