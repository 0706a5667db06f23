#include "core/body/torso_landmarks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/body/cleft.h"

namespace capfit::body {
namespace {

// Lengths are shares of the stature.

// Where on the leg, counted from its tip, the knees are that the cleft is looked for between.
constexpr double kKneeArc = 0.36;
constexpr double kCrotchBehindThighs = 0.022;
// The neck leans forward by about this angle; its sections are cut across that direction.
constexpr double kNeckLeanRad = 0.30;
constexpr double kLevelStep = 0.004;
// The neck is looked for from here above the armpits up to here below the top.
constexpr double kNeckAboveArmpit = 0.05;
constexpr double kNeckBelowTop = 0.08;
// The base of the neck lies this far below its narrowest place.
constexpr double kNeckBaseBelowNarrowest = 0.025;
// A head is wider than the neck it sits on.
constexpr double kHeadWiderThanNeck = 1.3;

constexpr double kHipFrom = 0.010;
constexpr double kHipTo = 0.110;
constexpr double kWaistAboveCrotch = 0.080;
constexpr double kBustBelowArmpit = 0.080;

Landmark Measured(const Eigen::Vector3d& position_m, double confidence) {
  return {position_m, LandmarkMethod::kMeasured, confidence};
}

// The trunk's loop in a plane: the largest closed one near the middle.
std::optional<SectionLoop> TrunkLoop(const Shape& shape, const CutPlane& plane) {
  for (SectionLoop& loop : CutSection(shape.points, shape.triangles, plane)) {
    if (!loop.is_closed) continue;
    if (loop.Min(Eigen::Vector3d::UnitX()) > 0.0 || loop.Max(Eigen::Vector3d::UnitX()) < 0.0) {
      continue;
    }
    return std::move(loop);
  }
  return std::nullopt;
}

CutPlane Level(double y) { return {Eigen::Vector3d(0, y, 0), Eigen::Vector3d::UnitY()}; }

// Lowest point of the surface in the symmetry plane near (y, z), looking up from between the legs.
double CrotchHeightAt(const Shape& shape, const Eigen::Vector3d& near) {
  const CutPlane plane = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
  double best = std::numeric_limits<double>::infinity();
  double height = near.y();
  for (const SectionLoop& loop : CutSection(shape.points, shape.triangles, plane)) {
    const std::size_t count = loop.outline.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& a = loop.outline[i];
      const Eigen::Vector3d& b = loop.outline[(i + 1) % count];
      if ((a.z() - near.z()) * (b.z() - near.z()) > 0.0 || a.z() == b.z()) continue;
      const double y = a.y() + (near.z() - a.z()) / (b.z() - a.z()) * (b.y() - a.y());
      if (std::abs(y - near.y()) >= best) continue;
      best = std::abs(y - near.y());
      height = y;
    }
  }
  return best < 0.04 * shape.stature_m ? height : near.y();
}

}  // namespace

void FindCrotch(const Shape& shape, Landmarks& landmarks) {
  std::array<std::uint32_t, 2> knees = {0, 0};
  Eigen::Vector3d thighs = Eigen::Vector3d::Zero();
  for (const int side : {kLeft, kRight}) {
    const LimbProfile& leg = *shape.leg_profiles[side];
    const Eigen::Vector3d knee = leg.At(kKneeArc * shape.stature_m).center;
    thighs += 0.5 * leg.stations.back().center;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : shape.legs[side]->vertices) {
      const double distance = (shape.points[v] - knee).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      knees[side] = v;
    }
  }
  const auto cleft =
      FindCleft(shape.points, *shape.graph, knees[kLeft], knees[kRight], -Eigen::Vector3d::UnitY());
  if (!cleft) return;
  // The perineum is nearly flat from front to back; a place behind the middle of the thighs is a
  // steadier choice along it than the cleft's own vertex.
  Eigen::Vector3d crotch(0.0, shape.points[*cleft].y(),
                         thighs.z() - kCrotchBehindThighs * shape.stature_m);
  crotch.y() = CrotchHeightAt(shape, crotch);
  landmarks[Index(LandmarkId::kCrotch)] = Measured(crotch, 0.9);
}

void FindNeck(Shape& shape, Landmarks& landmarks) {
  double armpit_y = 0.0;
  int armpits = 0;
  for (const int side : {kLeft, kRight}) {
    if (!landmarks[Sided(LandmarkId::kLeftArmpit, side)]) continue;
    armpit_y += landmarks[Sided(LandmarkId::kLeftArmpit, side)]->position_m.y();
    ++armpits;
  }
  armpit_y = armpits > 0 ? armpit_y / armpits : 0.74 * shape.stature_m;
  const double stature = shape.stature_m;
  const Eigen::Vector3d lean(0, std::cos(kNeckLeanRad), std::sin(kNeckLeanRad));
  std::vector<std::pair<double, SectionLoop>> levels;
  for (double y = armpit_y + kNeckAboveArmpit * stature; y < shape.top_m;
       y += kLevelStep * stature) {
    auto loop = TrunkLoop(shape, {Eigen::Vector3d(0, y, 0), lean});
    if (loop) levels.emplace_back(y, std::move(*loop));
  }
  if (levels.empty()) return;
  std::size_t narrowest = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].first > shape.top_m - kNeckBelowTop * stature && i > 4) break;
    if (levels[i].second.girth < levels[narrowest].second.girth) narrowest = i;
  }
  double widest_above = 0.0;
  for (std::size_t i = narrowest; i < levels.size(); ++i) {
    widest_above = std::max(widest_above, levels[i].second.girth);
  }
  shape.has_head = widest_above > kHeadWiderThanNeck * levels[narrowest].second.girth;
  if (!shape.has_head) {
    landmarks[Index(LandmarkId::kNeck)] = Measured(levels.back().second.centroid, 0.8);
    return;
  }
  const double base = levels[narrowest].first - kNeckBaseBelowNarrowest * stature;
  const auto loop = TrunkLoop(shape, {Eigen::Vector3d(0, base, 0), lean});
  Eigen::Vector3d neck = levels[narrowest].second.centroid;
  if (loop) neck = loop->centroid;
  landmarks[Index(LandmarkId::kNeck)] = Measured(neck, 0.8);
  Eigen::Vector3d top = Eigen::Vector3d::Zero();
  for (const std::uint32_t v : shape.head->vertices) {
    if (shape.points[v].y() > top.y()) top = shape.points[v];
  }
  landmarks[Index(LandmarkId::kHeadTop)] = Measured(top, 0.95);
}

void FindTrunkSections(const Shape& shape, Landmarks& landmarks) {
  const double stature = shape.stature_m;
  const double crotch = landmarks[Index(LandmarkId::kCrotch)]->position_m.y();
  double armpit = crotch + 0.27 * stature;
  for (const int side : {kLeft, kRight}) {
    const auto& found = landmarks[Sided(LandmarkId::kLeftArmpit, side)];
    if (found) armpit = found->position_m.y();
  }
  struct Extreme {
    double value = -std::numeric_limits<double>::infinity();
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    void Offer(double candidate, const Eigen::Vector3d& at) {
      if (candidate <= value) return;
      value = candidate;
      centroid = at;
    }
  };
  Extreme hip, waist, bust;
  for (double y = crotch + kHipFrom * stature; y < armpit; y += kLevelStep * stature) {
    const auto loop = TrunkLoop(shape, Level(y));
    if (!loop) continue;
    const double above = (y - crotch) / stature;
    const double below = (armpit - y) / stature;
    if (above <= kHipTo) hip.Offer(loop->girth, loop->centroid);
    if (above >= kWaistAboveCrotch && below >= kBustBelowArmpit) {
      waist.Offer(-loop->girth, loop->centroid);
    }
    const double depth = loop->Max(Eigen::Vector3d::UnitZ()) - loop->Min(Eigen::Vector3d::UnitZ());
    if (below < kBustBelowArmpit) bust.Offer(depth, loop->centroid);
  }
  const auto set = [&](LandmarkId id, const Extreme& extreme) {
    if (std::isfinite(extreme.value)) landmarks[Index(id)] = Measured(extreme.centroid, 0.8);
  };
  set(LandmarkId::kHip, hip);
  set(LandmarkId::kWaist, waist);
  set(LandmarkId::kBust, bust);
}

}  // namespace capfit::body
