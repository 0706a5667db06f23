#include "tests/fuzz/body_promises.h"

#include <cmath>
#include <cstddef>

#include "core/base/status.h"

namespace capfit::fuzz {
namespace {

std::string BrokenByRefusal(const absl::Status& status) {
  if (status.message().empty()) return "a refusal without a message";
  switch (status.code()) {
    case absl::StatusCode::kInvalidArgument:
      return {};
    case absl::StatusCode::kFailedPrecondition:
      return ReasonOf(status).has_value() ? std::string() : "a refusal without a reason";
    default:
      return "an unexpected error: " + status.ToString();
  }
}

std::string BrokenByCurve(const body::MedialCurve& curve) {
  if (curve.points_m.size() < 2) return "a medial curve has fewer than two points";
  if (curve.points_m.size() != curve.arc_length_m.size()) return "a medial curve has odd sizes";
  if (curve.arc_length_m.front() != 0.0) return "a medial curve does not start at 0";
  for (std::size_t i = 0; i < curve.points_m.size(); ++i) {
    if (!curve.points_m[i].allFinite()) return "a point of a medial curve is not finite";
    if (i > 0 && !(curve.arc_length_m[i] > curve.arc_length_m[i - 1])) {
      return "the arc length of a medial curve does not grow";
    }
  }
  return std::isfinite(curve.length_m()) ? std::string() : "a medial curve is endless";
}

std::string BrokenByLandmark(const body::Landmark& landmark) {
  if (!landmark.position_m.allFinite()) return "a landmark is not finite";
  if (landmark.confidence >= 0.0 && landmark.confidence <= 1.0) return {};
  return "a landmark's confidence is out of range";
}

std::string BrokenByFrame(const body::Body& body) {
  if (!std::isfinite(body.height_m) || body.height_m <= 0.0) return "the height is no length";
  const geometry::Similarity& frame = body.body_from_caller;
  if (!std::isfinite(frame.scale) || frame.scale <= 0.0) return "the scale is no scale";
  for (const Eigen::Vector3d& vertex : body.mesh.vertices()) {
    if (!vertex.allFinite()) return "a vertex is not finite in the body frame";
  }
  return {};
}

}  // namespace

std::string BrokenPromiseOfBody(const absl::StatusOr<body::Body>& found) {
  if (!found.ok()) return BrokenByRefusal(found.status());
  if (std::string broken = BrokenByFrame(*found); !broken.empty()) return broken;
  if (found->vertex_segments.size() != found->mesh.vertices().size()) {
    return "vertex_segments has a wrong size";
  }
  for (const auto& landmark : found->landmarks) {
    if (!landmark.has_value()) continue;
    if (std::string broken = BrokenByLandmark(*landmark); !broken.empty()) return broken;
  }
  for (const auto& chain : found->chains) {
    if (!chain.has_value()) continue;
    if (std::string broken = BrokenByCurve(*chain); !broken.empty()) return broken;
  }
  for (const Warning& warning : found->warnings) {
    if (warning.code.empty() || warning.message.empty()) return "a warning says nothing";
  }
  return {};
}

}  // namespace capfit::fuzz
