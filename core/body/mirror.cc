#include "core/body/mirror.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/enum_index.h"

namespace capfit::body {
namespace {

// All shares of the height.
constexpr double kTolerance = 0.010;
// Toes and fingertips are single vertices; on scans they may be a finger apart.
constexpr double kTipTolerance = 0.035;
// Joints and surface are compared; 3 % of the surface may miss (hair, a thumb).
constexpr double kShareThatMustMirror = 0.97;
constexpr double kLevelStep = 0.04;
constexpr int kDirections = 16;

Eigen::Vector3d Mirrored(const Eigen::Vector3d& p) { return {-p.x(), p.y(), p.z()}; }

bool IsTip(LandmarkId id) {
  return id >= LandmarkId::kLeftFingertip && id <= LandmarkId::kRightHeel;
}

bool LandmarksMirror(const Shape& shape, const Landmarks& landmarks) {
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const LandmarkId id = static_cast<LandmarkId>(i);
    // An armpit's place along its fold is free; the shoulder says the same better.
    if (id == LandmarkId::kLeftArmpit || id == LandmarkId::kRightArmpit) continue;
    const auto& here = landmarks[i];
    const auto& there = landmarks[Index(MirrorLandmark(id))];
    if (here.has_value() != there.has_value()) return false;
    if (!here) continue;
    const double miss = (here->position_m - Mirrored(there->position_m)).norm();
    if (miss > (IsTip(id) ? kTipTolerance : 2.0 * kTolerance) * shape.stature_m) return false;
  }
  return true;
}

// 1 for a landmark that the caller told, 0 for one that was found.
double WordOf(const Landmark& landmark) {
  return landmark.method == LandmarkMethod::kCaller ? 1.0 : 0.0;
}

double SquaredMiss(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d step = b - a;
  const double along = (p - a).dot(step);
  const double length_squared = step.squaredNorm();
  if (along >= length_squared) return (p - b).squaredNorm();
  const double miss = (p - a).squaredNorm();
  return along > 0.0 ? miss - along * along / length_squared : miss;
}

// Whether the outline passes near the point. `at`: where it last did; mirror images of points that
// follow each other meet it ever further back.
bool IsNearOutline(const SectionLoop& loop, const Eigen::Vector3d& p, double tolerance,
                   std::size_t& at) {
  const std::size_t count = loop.outline.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = at == 0 ? count - 1 : at - 1;
    if (SquaredMiss(p, loop.outline[before], loop.outline[at]) <= tolerance * tolerance) {
      return true;
    }
    at = before;
  }
  return false;
}

// Of outlines: how long they are, and how much of that has no mirror image.
struct Mirroring {
  double length = 0.0;
  double missing = 0.0;
};

Mirroring HowItMirrors(const std::vector<SectionLoop>& loops, double tolerance) {
  Mirroring sum;
  for (const SectionLoop& loop : loops) {
    const std::size_t step = std::max<std::size_t>(1, loop.outline.size() / kDirections);
    std::vector<std::size_t> at(loops.size(), 0);
    for (std::size_t i = 0; i < loop.outline.size(); i += step) {
      const Eigen::Vector3d image = Mirrored(loop.outline[i]);
      bool is_met = false;
      for (std::size_t k = 0; k < loops.size() && !is_met; ++k) {
        is_met = IsNearOutline(loops[k], image, tolerance, at[k]);
      }
      const double share =
          loop.girth * static_cast<double>(step) / static_cast<double>(loop.outline.size());
      sum.length += share;
      if (!is_met) sum.missing += share;
    }
  }
  return sum;
}

// Level sections against their own mirror images, by outline length.
bool SurfaceMirrors(const Shape& shape) {
  const double tolerance = 1.5 * kTolerance * shape.stature_m;
  std::vector<CutPlane> levels;
  for (double y = 0.5 * kLevelStep * shape.stature_m; y < shape.top_m;
       y += kLevelStep * shape.stature_m) {
    levels.push_back({Eigen::Vector3d(0, y, 0), Eigen::Vector3d::UnitY()});
  }
  std::vector<Mirroring> sections(levels.size());
  shape.pool->ForEach(levels.size(), [&](std::size_t i) {
    sections[i] = HowItMirrors(shape.surface->Cut(levels[i]), tolerance);
  });
  Mirroring all;
  for (const Mirroring& section : sections) {
    all.length += section.length;
    all.missing += section.missing;
  }
  return all.missing <= (1.0 - kShareThatMustMirror) * all.length;
}

}  // namespace

bool IsSymmetric(const Shape& shape, const Landmarks& landmarks) {
  if (shape.arms[kLeft].has_value() != shape.arms[kRight].has_value()) return false;
  if (shape.legs[kLeft].has_value() != shape.legs[kRight].has_value()) return false;
  return LandmarksMirror(shape, landmarks) && SurfaceMirrors(shape);
}

void Symmetrise(Landmarks& landmarks) {
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const std::size_t other = Index(MirrorLandmark(static_cast<LandmarkId>(i)));
    if (other < i || !landmarks[i] || !landmarks[other]) continue;
    // What was told on one side only is right for both.
    const double share = WordOf(*landmarks[i]) - WordOf(*landmarks[other]);
    const Eigen::Vector3d mean = (0.5 + 0.5 * share) * landmarks[i]->position_m +
                                 (0.5 - 0.5 * share) * Mirrored(landmarks[other]->position_m);
    landmarks[i]->position_m = mean;
    landmarks[other]->position_m = Mirrored(mean);
    if (other == i) landmarks[i]->position_m.x() = 0.0;
  }
}

void Symmetrise(Shape& shape) {
  shape.trunk_base_m.x() = 0.0;
  if (shape.neck_base_m) shape.neck_base_m->x() = 0.0;
  if (shape.neck_middle_m) shape.neck_middle_m->x() = 0.0;
}

void Symmetrise(std::array<std::optional<MedialCurve>, kChainCount>& chains) {
  if (chains[0]) {
    for (Eigen::Vector3d& p : chains[0]->points_m) p.x() = 0.0;
    *chains[0] = CurveThrough(chains[0]->points_m);
  }
  for (const Part part : {Part::kLeftArm, Part::kLeftLeg}) {
    auto& left = chains[Index(part)];
    auto& right = chains[Index(MirrorPart(part))];
    if (!left || !right) continue;
    for (std::size_t i = 0; i < left->points_m.size(); ++i) {
      left->points_m[i] = 0.5 * (left->points_m[i] + Mirrored(right->points_m[i]));
      right->points_m[i] = Mirrored(left->points_m[i]);
    }
    *left = CurveThrough(left->points_m);
    *right = CurveThrough(right->points_m);
  }
}

}  // namespace capfit::body
