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
#include "core/mannequin/girth.h"
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
      field, absl::StrCat("is ", value, ", must be in [", range.low, ", ", range.high, "]"));
}

absl::Status CheckGirth(const std::string& field, const std::optional<double>& girth_m,
                        double usual_m, double spread) {
  if (!girth_m) return absl::OkStatus();
  CAPFIT_RETURN_IF_ERROR(CheckRange(field, *girth_m, {0.5, 1.8}));
  const Range human{usual_m * (1.0 - spread), usual_m * (1.0 + spread)};
  if (*girth_m >= human.low && *girth_m <= human.high) return absl::OkStatus();
  return InvalidField(field, absl::StrCat("is ", *girth_m, ", must be in [", human.low, ", ",
                                          human.high, "] for this sex and height"));
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

// A sampled half body in body heights, with all details.
struct HalfBody {
  QuadMesh mesh;
  std::size_t trunk_quads = 0;  // its first ones
};

Divisions Even(const QuadMesh& cage, int pieces) {
  Divisions divisions;
  divisions.faces.assign(cage.quads.size(), {pieces, pieces});
  return divisions;
}

HalfBody SampleBody(const BodyShape& shape, const BodyCage& cage, const SmoothSurface& surface,
                    const Divisions& divisions) {
  HalfBody body{Sample(cage.half, surface, divisions)};
  for (std::size_t f = 0; f < cage.trunk_end; ++f) {
    body.trunk_quads += static_cast<std::size_t>(divisions.faces[f][0]) *
                        static_cast<std::size_t>(divisions.faces[f][1]);
  }
  ApplyBumps(BodyBumps(shape, cage), body.mesh.vertices);
  return body;
}

// Girths of a body, each as a part of its height.
struct Girths {
  double bust, waist, hip;
};

Girths MeasureGirths(const HalfBody& body, double height) {
  const std::vector<Quad> trunk(
      body.mesh.quads.begin(),
      body.mesh.quads.begin() + static_cast<std::ptrdiff_t>(body.trunk_quads));
  const auto girth = [&](double level) {
    return HalfBodyGirth(body.mesh.vertices, trunk, level * height) / height;
  };
  return {girth(kBustLevel), girth(kWaistLevel), girth(kHipLevel)};
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

struct FittedShape {
  BodyShape shape;
  double height = 1.0;  // of the smooth surface, soles to crown, in the cage's unit
};

// Girths follow their factors almost in proportion and hardly each other's, so that correcting each
// by what is missing converges in a few steps.
FittedShape FitShape(const MannequinOptions& options) {
  constexpr int kMaxSteps = 12;
  constexpr double kTolerance = 5e-4;
  const Girths wanted = WantedGirths(options);
  FittedShape fitted;
  fitted.shape.sex = options.sex;
  fitted.shape.arm_angle_rad = ArmAngle(options);
  fitted.shape.head_factor = HeadFactor(options.height_m);
  for (int step = 0; step < kMaxSteps; ++step) {
    const BodyCage cage = BuildBodyCage(fitted.shape);
    const SmoothSurface surface(WithMirrorImage(cage.half), 2);
    const HalfBody body = SampleBody(fitted.shape, cage, surface, Even(cage.half, 4));
    fitted.height = 0.0;
    for (const Vector3d& p : body.mesh.vertices) fitted.height = std::max(fitted.height, p.y());
    const Girths found = MeasureGirths(body, fitted.height);
    const Girths ratio{wanted.bust / found.bust, wanted.waist / found.waist,
                       wanted.hip / found.hip};
    if (std::max({std::abs(ratio.bust - 1), std::abs(ratio.waist - 1), std::abs(ratio.hip - 1)}) <
        kTolerance) {
      break;
    }
    fitted.shape.bust_factor *= ratio.bust;
    fitted.shape.waist_factor *= ratio.waist;
    fitted.shape.hip_factor *= ratio.hip;
  }
  return fitted;
}

// How finely the smooth surface must be known for these divisions; beyond 2^4 points along an edge
// of the cage (about 3 mm) straight lines between them are as good as the surface.
int LevelsFor(const Divisions& divisions) {
  int levels = 2;
  while (levels < 4 && (1 << levels) < divisions.largest) ++levels;
  return levels;
}

mesh::PolygonSoup ToSoup(const QuadMesh& half, double scale_m, bool quads) {
  const QuadMesh whole = WithMirrorImage(half);
  mesh::PolygonSoup soup;
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

absl::StatusOr<mesh::PolygonSoup> MakeMannequin(const MannequinOptions& options) {
  CAPFIT_RETURN_IF_ERROR(Validate(options));
  FittedShape fitted = FitShape(options);
  fitted.shape.with_head = options.with_head;
  fitted.shape.with_hands = options.with_hands;
  fitted.shape.with_feet = options.with_feet;
  const BodyCage cage = BuildBodyCage(fitted.shape);
  const QuadMesh whole = WithMirrorImage(cage.half);
  const Divisions divisions =
      ChooseDivisions(cage.half, SmoothSurface(whole, 2), options.faces / (options.quads ? 2 : 4));
  const HalfBody body =
      SampleBody(fitted.shape, cage, SmoothSurface(whole, LevelsFor(divisions)), divisions);
  return ToSoup(body.mesh, options.height_m / fitted.height, options.quads);
}

}  // namespace capfit::mannequin
