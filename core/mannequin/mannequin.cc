#include "core/mannequin/mannequin.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/mannequin/body_cage.h"
#include "core/mannequin/body_details.h"
#include "core/mannequin/catmull_clark.h"
#include "core/mannequin/fit_shape.h"
#include "core/mannequin/proportions.h"
#include "core/mannequin/quad_sampling.h"

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;

struct Range {
  double low;
  double high;
};

// Also refuses NaN.
absl::Status CheckRange(const std::string& field, double value, const Range& range) {
  if (value >= range.low && value <= range.high) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kOutOfRange, field,
      absl::StrCat("is ", value, ", must be in [", range.low, ", ", range.high, "]"));
}

absl::Status CheckGirth(const std::string& field, const std::optional<double>& girth_m,
                        double usual_m, double spread) {
  if (!girth_m) return absl::OkStatus();
  CAPFIT_RETURN_IF_ERROR(CheckRange(field, *girth_m, {0.5, 1.8}));
  const Range human{usual_m * (1.0 - spread), usual_m * (1.0 + spread)};
  if (*girth_m >= human.low && *girth_m <= human.high) return absl::OkStatus();
  return InvalidField(ErrorReason::kOutOfRange, field,
                      absl::StrCat("is ", *girth_m, ", must be in [", human.low, ", ", human.high,
                                   "] for this sex and height"));
}

absl::Status Validate(const MannequinOptions& options) {
  const Proportions& usual = ProportionsOf(options.sex);
  const double height_m = options.height_m;
  CAPFIT_RETURN_IF_ERROR(CheckRange("height_m", height_m, {0.8, 2.3}));
  CAPFIT_RETURN_IF_ERROR(
      CheckGirth("bust_m", options.bust_m, usual.bust_girth * height_m, 1.0 / 3.0));
  CAPFIT_RETURN_IF_ERROR(CheckGirth("waist_m", options.waist_m, usual.waist_girth * height_m, 0.5));
  CAPFIT_RETURN_IF_ERROR(CheckGirth("hip_m", options.hip_m, usual.hip_girth * height_m, 1.0 / 3.0));
  if (options.arm_angle_rad) {
    CAPFIT_RETURN_IF_ERROR(CheckRange("arm_angle_rad", *options.arm_angle_rad, {0.15, 2.0}));
  }
  return CheckRange("faces", options.faces, {2000, 500'000});
}

double ArmAngle(const MannequinOptions& options) {
  if (options.arm_angle_rad) return *options.arm_angle_rad;
  switch (options.pose) {
    case MannequinPose::kT:
      return std::numbers::pi / 2;
    case MannequinPose::kA:
      return std::numbers::pi / 4;
    case MannequinPose::kSides:
      break;
  }
  return std::numbers::pi / 12;
}

Girths WantedGirths(const MannequinOptions& options) {
  const Proportions& usual = ProportionsOf(options.sex);
  const auto ratio = [&](const std::optional<double>& girth_m, double usual_ratio) {
    return girth_m ? *girth_m / options.height_m : usual_ratio;
  };
  return {ratio(options.bust_m, usual.bust_girth), ratio(options.waist_m, usual.waist_girth),
          ratio(options.hip_m, usual.hip_girth)};
}

// The smaller the person, the younger, and the larger the head: a third at 0.8 m.
double HeadFactor(double height_m) {
  return 1.0 + 0.35 * std::clamp((1.55 - height_m) / 0.75, 0.0, 1.0);
}

BodyShape UsualShape(const MannequinOptions& options) {
  BodyShape shape;
  shape.sex = options.sex;
  shape.arm_angle_rad = ArmAngle(options);
  shape.head_factor = HeadFactor(options.height_m);
  shape.with_head = options.with_head;
  shape.with_hands = options.with_hands;
  shape.with_feet = options.with_feet;
  return shape;
}

formats::PolygonSoup ToSoup(const QuadMesh& half, double scale_m, bool quads) {
  const QuadMesh whole = WithMirrorImage(half);
  formats::PolygonSoup soup;
  soup.positions.reserve(whole.vertices.size());
  for (const Vector3d& p : whole.vertices) soup.positions.push_back(scale_m * p);
  for (const Quad& q : whole.quads) {
    if (quads) {
      soup.face_sizes.push_back(4);
      soup.face_vertices.insert(soup.face_vertices.end(), q.begin(), q.end());
      continue;
    }
    const auto length = [&](std::size_t a, std::size_t b) {
      return (whole.vertices[q[a]] - whole.vertices[q[b]]).squaredNorm();
    };
    // Along the shorter diagonal; mirrored quads have the same two diagonals.
    const std::size_t start = length(0, 2) <= length(1, 3) ? 0 : 1;
    for (const std::size_t k : {start, start + 2}) {
      soup.face_vertices.insert(soup.face_vertices.end(), {q[k], q[(k + 1) % 4], q[(k + 2) % 4]});
    }
  }
  return soup;
}

}  // namespace

absl::StatusOr<formats::PolygonSoup> MakeMannequin(const MannequinOptions& options) {
  CAPFIT_RETURN_IF_ERROR(Validate(options));
  BodyShape shape = UsualShape(options);
  const double height = WholeHeight(shape);
  const Divisions divisions =
      FitShape(WantedGirths(options), height, options.faces / (options.quads ? 2 : 4), shape);
  const BodyCage cage = BuildBodyCage(shape);
  const SmoothSurface surface(WithMirrorImage(cage.half), LevelsFor(divisions));
  QuadMesh half = Sample(cage.half, surface, divisions);
  ApplyBumps(BodyBumps(shape, cage), half.vertices);
  return ToSoup(half, options.height_m / height, options.quads);
}

}  // namespace capfit::mannequin
