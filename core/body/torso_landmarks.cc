#include "core/body/torso_landmarks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/enum_index.h"
#include "core/body/cleft.h"

namespace capfit::body {
namespace {

// Lengths are shares of the stature.

// Where on the thighs, counted from the inner end of the legs' middle lines, the ends are that the
// cleft is looked for between, and how far around the crotch the ways may lead.
constexpr double kThighBelowEnd = 0.10;
constexpr double kCrotchRegion = 0.20;
// Of ways over the surface, in units of the square root of its area: those that are longer than the
// shortest by this count e times less.
constexpr double kSoftMinimum = 0.01;
constexpr double kCrotchBehindThighs = 0.022;
constexpr double kCrotchBehindHalfWay = 0.030;
// The neck leans forward by about this angle; its sections are cut across that direction.
constexpr double kNeckLeanRad = 0.30;
constexpr double kTrunkLevelStep = 0.005;
// The neck is looked for from here above the armpits up to here below the top.
constexpr double kNeckAboveArmpit = 0.05;
constexpr double kNeckBelowTop = 0.08;
// The base of the neck lies this far below its narrowest place.
constexpr double kNeckBaseBelowNarrowest = 0.025;
// A cut through the neck is ragged: sections at it that have lost this share of the area below are
// pieces.
constexpr double kWholeNeckShare = 0.8;
// Height of the armpits where there are no arms.
constexpr double kArmpitAboveCrotch = 0.270;
// A section that reaches further out than the armpit by this has caught an arm.
constexpr double kBesideArmpit = 0.03;

constexpr double kHipFrom = 0.010;
constexpr double kHipTo = 0.110;
constexpr double kWaistAboveCrotch = 0.080;
constexpr double kBustBelowArmpit = 0.080;

// The trunk's loop in a section: the largest closed one near the middle.
std::optional<SectionLoop> TrunkLoop(std::vector<SectionLoop> section) {
  for (SectionLoop& loop : section) {
    if (!loop.is_closed) continue;
    if (loop.Min(Eigen::Vector3d::UnitX()) > 0.0 || loop.Max(Eigen::Vector3d::UnitX()) < 0.0) {
      continue;
    }
    return std::move(loop);
  }
  return std::nullopt;
}

std::vector<std::optional<SectionLoop>> TrunkLoops(const CutSurface& surface,
                                                   std::span<const CutPlane> planes,
                                                   const ThreadPool& pool) {
  std::vector<std::optional<SectionLoop>> loops;
  for (std::vector<SectionLoop>& section : surface.CutAll(planes, pool)) {
    loops.push_back(TrunkLoop(std::move(section)));
  }
  return loops;
}

CutPlane Level(double y) { return {Eigen::Vector3d(0, y, 0), Eigen::Vector3d::UnitY()}; }

// Lowest point of the surface in the symmetry plane near (y, z), looking up from between the legs.
double CrotchHeightAt(const Shape& shape, const Eigen::Vector3d& near) {
  const CutPlane plane = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
  double best = std::numeric_limits<double>::infinity();
  double height = near.y();
  for (const SectionLoop& loop : shape.mesh_surface->Cut(plane)) {
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

namespace {

struct Thighs {
  double hanging = 1.0;   // 1 where both hang down, 0 where one of them is lifted
  double middle_z = 0.0;  // depth of the middle between their inner ends
  double forward = 0.0;   // sines of how far they are lifted to the front, added up
};

Thighs MeasureThighs(const Shape& shape) {
  Thighs thighs;
  for (const int side : {kLeft, kRight}) {
    const LimbProfile& leg = *shape.leg_profiles[side];
    const Eigen::Vector3d root = leg.stations.back().center;
    const Eigen::Vector3d down =
        (leg.At(leg.end() - kThighBelowEnd * shape.stature_m).center - root).normalized();
    const double lift = std::abs(std::atan2(down.z(), -down.y()));
    const double share = (kLiftedThighRad - lift) / (kLiftedThighRad - kHangingThighRad);
    thighs.hanging = std::min(thighs.hanging, std::clamp(share, 0.0, 1.0));
    thighs.middle_z += 0.5 * root.z();
    thighs.forward += down.z();
  }
  return thighs;
}

// The innermost place between two thighs that hang down.
std::optional<Eigen::Vector3d> CrotchBetweenHanging(const Shape& shape, const Thighs& thighs) {
  std::array<std::uint32_t, 2> ends = {0, 0};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
  for (const int side : {kLeft, kRight}) {
    const LimbProfile& leg = *shape.leg_profiles[side];
    const Eigen::Vector3d thigh = leg.At(leg.end() - kThighBelowEnd * shape.stature_m).center;
    middle += 0.5 * leg.stations.back().center;
    outward += (thigh - leg.stations.back().center).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : shape.legs[side]->vertices) {
      const double distance = (shape.points[v] - thigh).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      ends[side] = v;
    }
  }
  const auto cleft = FindCleft(shape, ends[kLeft], ends[kRight], outward.normalized(),
                               {middle, kCrotchRegion * shape.stature_m});
  if (!cleft) return std::nullopt;
  // The perineum is nearly flat from front to back; a place behind the middle of the thighs is a
  // steadier choice along it than the cleft's own vertex.
  Eigen::Vector3d crotch(0.0, cleft->y(), thighs.middle_z - kCrotchBehindThighs * shape.stature_m);
  crotch.y() = CrotchHeightAt(shape, crotch);
  return crotch;
}

// Half-way on the shortest way over the surface from foot to foot: it leads up one leg and down the
// other on their inner sides, however they are lifted or bent. A soft minimum, so that no single
// vertex decides.
Eigen::Vector3d HalfWayBetweenFeet(const Shape& shape) {
  const auto [left, right] = DistancesFromFeet(shape);
  if (shape.observer->IsCancelled()) return Eigen::Vector3d::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < left.size(); ++v) {
    nearest = std::min(nearest, std::max(left[v], right[v]));
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (std::size_t v = 0; v < left.size(); ++v) {
    const double longer = (std::max(left[v], right[v]) - nearest) / kSoftMinimum;
    if (longer > 20.0) continue;
    const double weight = std::exp(-longer);
    sum += weight * shape.points[v];
    total += weight;
  }
  return sum / total;
}

}  // namespace

void FindCrotch(const Shape& shape, Landmarks& landmarks) {
  const Thighs thighs = MeasureThighs(shape);
  std::optional<Eigen::Vector3d> hanging;
  if (thighs.hanging > 0.0) hanging = CrotchBetweenHanging(shape, thighs);
  const double share = hanging ? thighs.hanging : 0.0;
  Eigen::Vector3d crotch = hanging.value_or(Eigen::Vector3d::Zero());
  if (share < 1.0) {
    // The shortest way crosses before the perineum, the more so the more the thighs are lifted.
    const Eigen::Vector3d half_way =
        HalfWayBetweenFeet(shape) -
        kCrotchBehindHalfWay * shape.stature_m * thighs.forward * Eigen::Vector3d::UnitZ();
    crotch = share * crotch + (1.0 - share) * half_way;
  }
  crotch.x() = 0.0;
  Put(landmarks, Index(LandmarkId::kCrotch), crotch, 0.6 + 0.3 * share);
}

namespace {

struct NeckLevel {
  double y = 0.0;  // where the plane meets the Y axis
  SectionLoop loop;
};

CutPlane NeckPlane(double y) {
  return {Eigen::Vector3d(0, y, 0),
          Eigen::Vector3d(0, std::cos(kNeckLeanRad), std::sin(kNeckLeanRad))};
}

std::vector<NeckLevel> CutNeck(const CutSurface& surface, std::span<const double> heights,
                               const ThreadPool& pool) {
  std::vector<CutPlane> planes;
  for (const double y : heights) planes.push_back(NeckPlane(y));
  std::vector<std::optional<SectionLoop>> loops = TrunkLoops(surface, planes, pool);
  std::vector<NeckLevel> levels;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i]) levels.push_back({heights[i], *std::move(loops[i])});
  }
  return levels;
}

NeckLevel Narrowest(std::vector<NeckLevel> levels) {
  return std::move(*std::min_element(
      levels.begin(), levels.end(),
      [](const NeckLevel& a, const NeckLevel& b) { return a.loop.girth < b.loop.girth; }));
}

// Of the neck's sections the narrowest, or the uppermost whole one where there is no head: looked
// for among those of nodes, then cut through all triangles.
std::optional<NeckLevel> NeckMiddle(const Shape& shape, double from_y) {
  const double step = kTrunkLevelStep * shape.stature_m;
  const double to_y = shape.crown_m - (shape.has_head ? kNeckBelowTop * shape.stature_m : 0.0);
  std::vector<double> heights;
  for (double y = from_y; y < to_y; y += step) heights.push_back(y);
  std::vector<NeckLevel> levels = CutNeck(*shape.surface, heights, *shape.pool);
  if (levels.empty()) return std::nullopt;
  if (!shape.has_head) {
    while (levels.size() > 1 &&
           levels.back().loop.area < kWholeNeckShare * levels[levels.size() - 2].loop.area) {
      levels.pop_back();
    }
    heights = {levels.back().y};
  } else {
    const double narrowest = Narrowest(std::move(levels)).y;
    std::erase_if(heights, [&](double y) { return std::abs(y - narrowest) > 1.5 * step; });
  }
  levels = CutNeck(*shape.mesh_surface, heights, *shape.pool);
  if (levels.empty()) return std::nullopt;
  return Narrowest(std::move(levels));
}

double MeanArmpitHeight(const Shape& shape, const Landmarks& landmarks) {
  double sum = 0.0;
  int count = 0;
  for (const int side : {kLeft, kRight}) {
    const auto& armpit = landmarks[Sided(LandmarkId::kLeftArmpit, side)];
    if (!armpit || armpit->method == LandmarkMethod::kRatio) continue;
    sum += landmarks[Sided(LandmarkId::kLeftArmpit, side)]->position_m.y();
    ++count;
  }
  if (count > 0) return sum / count;
  return shape.trunk_base_m.y() + kArmpitAboveCrotch * shape.stature_m;
}

}  // namespace

void FindNeck(Shape& shape, Landmarks& landmarks) {
  const double stature = shape.stature_m;
  const std::optional<NeckLevel> middle =
      NeckMiddle(shape, MeanArmpitHeight(shape, landmarks) + kNeckAboveArmpit * stature);
  if (!middle) return;
  shape.neck_middle_m = middle->loop.centroid;
  if (!shape.has_head) {
    shape.neck_base_m =
        *shape.neck_middle_m - kNeckBaseBelowNarrowest * stature * NeckPlane(0).normal;
    Put(landmarks, Index(LandmarkId::kNeck), *shape.neck_middle_m, shape.head ? 0.8 : 0.3);
    return;
  }
  const auto base =
      TrunkLoop(shape.mesh_surface->Cut(NeckPlane(middle->y - kNeckBaseBelowNarrowest * stature)));
  Put(landmarks, Index(LandmarkId::kNeck), base ? base->centroid : *shape.neck_middle_m, 0.8);
  shape.neck_base_m = landmarks[Index(LandmarkId::kNeck)]->position_m;
  Eigen::Vector3d top = Eigen::Vector3d::Zero();
  VisitVertices(shape, *shape.head, [&](const Eigen::Vector3d& p) {
    if (p.y() > top.y()) top = p;
  });
  Put(landmarks, Index(LandmarkId::kHeadTop), top, 0.95);
}

namespace {

// Whether a level section of the trunk runs out into an arm.
bool HasCaughtAnArm(const SectionLoop& loop, const Shape& shape, const Landmarks& landmarks) {
  for (const int side : {kLeft, kRight}) {
    const auto& armpit = landmarks[Sided(LandmarkId::kLeftArmpit, side)];
    if (!armpit) continue;
    const double reach = loop.Max(SideSign(side) * Eigen::Vector3d::UnitX());
    if (reach > SideSign(side) * armpit->position_m.x() + kBesideArmpit * shape.stature_m) {
      return true;
    }
  }
  return false;
}

}  // namespace

void FindTrunkSections(const Shape& shape, Landmarks& landmarks) {
  const double stature = shape.stature_m;
  const double crotch = shape.trunk_base_m.y();
  const double armpit = MeanArmpitHeight(shape, landmarks);
  struct Extreme {
    double value = -std::numeric_limits<double>::infinity();
    std::size_t level = 0;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  };
  Extreme hip, waist, bust;
  std::vector<double> heights;
  for (double y = crotch + kHipFrom * stature; y < armpit; y += kTrunkLevelStep * stature) {
    heights.push_back(y);
  }
  const auto offer = [&](std::size_t level, const SectionLoop& loop) {
    const auto offer_to = [&](Extreme& extreme, double value) {
      if (value > extreme.value) extreme = {value, level, loop.centroid};
    };
    const double above = (heights[level] - crotch) / stature;
    const double below = (armpit - heights[level]) / stature;
    if (above <= kHipTo) offer_to(hip, loop.girth);
    if (above >= kWaistAboveCrotch && below >= kBustBelowArmpit) offer_to(waist, -loop.girth);
    const double depth = loop.Max(Eigen::Vector3d::UnitZ()) - loop.Min(Eigen::Vector3d::UnitZ());
    if (below < kBustBelowArmpit && !HasCaughtAnArm(loop, shape, landmarks)) offer_to(bust, depth);
  };
  const auto cut = [&](const std::vector<std::size_t>& levels) {
    std::vector<CutPlane> planes;
    for (const std::size_t level : levels) planes.push_back(Level(heights[level]));
    const std::vector<std::optional<SectionLoop>> loops =
        TrunkLoops(*shape.mesh_surface, planes, *shape.pool);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      if (loops[i]) offer(levels[i], *loops[i]);
    }
  };
  // Every other one, then those beside the best.
  std::vector<std::size_t> levels;
  for (std::size_t level = 0; level < heights.size(); level += 2) levels.push_back(level);
  cut(levels);
  levels.clear();
  for (const Extreme* extreme : {&hip, &waist, &bust}) {
    if (extreme->level > 0) levels.push_back(extreme->level - 1);
    if (extreme->level + 1 < heights.size()) levels.push_back(extreme->level + 1);
  }
  cut(levels);
  const auto set = [&](LandmarkId id, const Extreme& extreme) {
    if (std::isfinite(extreme.value)) Put(landmarks, Index(id), extreme.centroid, 0.8);
  };
  // On a trunk that is cut off, the widest place above the cut is no hip, nor the narrowest a
  // waist.
  if (landmarks[Index(LandmarkId::kCrotch)]) {
    set(LandmarkId::kHip, hip);
    set(LandmarkId::kWaist, waist);
  }
  set(LandmarkId::kBust, bust);
}

}  // namespace capfit::body
