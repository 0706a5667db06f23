#include "core/body/chains.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/body/cross_section.h"

namespace capfit::body {
namespace {

constexpr int kCurvePoints = 33;
// Share of the stature.
constexpr double kArmpitBelowNeck = 0.12;

// Evenly spaced along the polyline; nothing when it has no length.
std::optional<MedialCurve> Evenly(const std::vector<Eigen::Vector3d>& line) {
  std::vector<double> arc(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) {
    arc[i] = arc[i - 1] + (line[i] - line[i - 1]).norm();
  }
  if (line.size() < 2 || arc.back() <= 0.0) return std::nullopt;
  std::vector<Eigen::Vector3d> points;
  std::size_t k = 1;
  for (int i = 0; i < kCurvePoints; ++i) {
    const double at = arc.back() * i / (kCurvePoints - 1);
    while (k + 1 < line.size() && (arc[k] < at || arc[k] <= arc[k - 1])) ++k;
    const double t = std::clamp((at - arc[k - 1]) / std::max(arc[k] - arc[k - 1], 1e-12), 0.0, 1.0);
    points.push_back(line[k - 1] + t * (line[k] - line[k - 1]));
  }
  return CurveThrough(points);
}

void Smooth(std::vector<Eigen::Vector3d>& line, int times) {
  for (int t = 0; t < times; ++t) {
    std::vector<Eigen::Vector3d> next = line;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      next[i] = 0.25 * line[i - 1] + 0.5 * line[i] + 0.25 * line[i + 1];
    }
    line = std::move(next);
  }
}

// Root, the profile's centres between the two arcs (they count from the tip), end.
std::optional<MedialCurve> LimbCurve(const LimbProfile& profile, const Eigen::Vector3d& root,
                                     const Eigen::Vector3d& end, double margin_m) {
  const double root_arc = profile.NearestArc(root) - margin_m;
  const double end_arc = profile.NearestArc(end) + margin_m;
  std::vector<Eigen::Vector3d> line = {root};
  for (auto s = profile.stations.rbegin(); s != profile.stations.rend(); ++s) {
    if (s->arc < root_arc && s->arc > end_arc) line.push_back(s->center);
  }
  line.push_back(end);
  Smooth(line, 6);
  return Evenly(line);
}

// Centroids of level sections up to the armpits, then a smooth way to the neck.
std::optional<MedialCurve> TrunkCurve(const Shape& shape, const Eigen::Vector3d& base,
                                      const Eigen::Vector3d& neck, double armpit_y) {
  const double stature = shape.stature_m;
  std::vector<Eigen::Vector3d> line = {base};
  std::vector<CutPlane> levels;
  for (double y = base.y() + 0.02 * stature; y < armpit_y - 0.01 * stature; y += 0.01 * stature) {
    levels.push_back({Eigen::Vector3d(0, y, 0), Eigen::Vector3d::UnitY()});
  }
  for (const std::vector<SectionLoop>& loops : shape.surface->CutAll(levels, *shape.pool)) {
    for (const SectionLoop& loop : loops) {
      if (!loop.is_closed) continue;
      if (loop.Min(Eigen::Vector3d::UnitX()) < 0.0 && loop.Max(Eigen::Vector3d::UnitX()) > 0.0) {
        line.push_back(loop.centroid);
        break;
      }
    }
  }
  const Eigen::Vector3d chest = line.back();
  for (int i = 1; i <= 10; ++i) line.push_back(chest + (i / 10.0) * (neck - chest));
  Smooth(line, 12);
  return Evenly(line);
}

}  // namespace

std::array<std::optional<MedialCurve>, kChainCount> BuildChains(const Shape& shape,
                                                                const Landmarks& landmarks) {
  std::array<std::optional<MedialCurve>, kChainCount> chains;
  const auto at = [&](LandmarkId left, int side) -> const std::optional<Landmark>& {
    return landmarks[Sided(left, side)];
  };
  const double margin = 0.02 * shape.stature_m;
  for (const int side : {kLeft, kRight}) {
    const auto& shoulder = at(LandmarkId::kLeftShoulder, side);
    const auto& wrist = at(LandmarkId::kLeftWrist, side);
    if (shape.arm_profiles[side] && shoulder && wrist) {
      chains[static_cast<int>(Part::kLeftArm) + side] =
          LimbCurve(*shape.arm_profiles[side], shoulder->position_m, wrist->position_m, margin);
    }
    const auto& hip = at(LandmarkId::kLeftHip, side);
    const auto& ankle = at(LandmarkId::kLeftAnkle, side);
    if (shape.leg_profiles[side] && hip && ankle) {
      chains[static_cast<int>(Part::kLeftLeg) + side] =
          LimbCurve(*shape.leg_profiles[side], hip->position_m, ankle->position_m, margin);
    }
  }
  if (shape.neck_middle_m) {
    double armpit_y = shape.neck_middle_m->y() - kArmpitBelowNeck * shape.stature_m;
    for (const int side : {kLeft, kRight}) {
      const auto& armpit = at(LandmarkId::kLeftArmpit, side);
      if (armpit) armpit_y = std::min(armpit_y, armpit->position_m.y());
    }
    chains[0] = TrunkCurve(shape, shape.trunk_base_m, *shape.neck_middle_m, armpit_y);
  }
  return chains;
}

}  // namespace capfit::body
