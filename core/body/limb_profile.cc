#include "core/body/limb_profile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace capfit::body {
namespace {

using Line = std::vector<Eigen::Vector3d>;

// All lengths are shares of the stature.
constexpr double kDraftSpacing = 0.016;
constexpr double kSpacing = 0.008;
// Sections stand across the chord from this far before to this far behind them.
constexpr double kChord = 0.016;
constexpr double kFirstStation = 0.006;
// Beyond this it is none: a body pressed flat along its height is all limbs.
constexpr double kLongestLimb = 2.0;
// How far past the rings the line goes on, straight, so that it reaches into the trunk.
constexpr double kExtension = 0.12;
// Rings near the junction are skew (the way to the armpit is shorter than that over the shoulder):
// this share of them, next to the trunk, is left out.
constexpr double kSkewShare = 0.15;
// Share of the way along the others on which the line is in the limb for sure.
constexpr double kSureShare = 0.92;
constexpr int kRings = 40;
// A section further from the line than this is not the limb's own.
constexpr double kMaxDrift = 0.035;
constexpr double kMinGirth = 0.015;
// A section that grows faster than this (relative, per stature) has run into the trunk.
constexpr double kGrowth = 60.0;
// Triangles of the trunk within this distance of the line's inner end take part in the sections.
constexpr double kTrunkReach = 0.17;

// (1 2 1) / 4, ends fixed.
void SmoothLine(Line& line, int times) {
  for (int t = 0; t < times; ++t) {
    Line next = line;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      next[i] = 0.25 * line[i - 1] + 0.5 * line[i] + 0.25 * line[i + 1];
    }
    line = std::move(next);
  }
}

double LengthOf(const Line& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

// At most `most` points.
Line Resample(const Line& line, double first, double spacing, std::size_t most) {
  Line out;
  double walked = 0.0;
  double wanted = first;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector3d step = line[i] - line[i - 1];
    const double length = step.norm();
    while (length > 0.0 && wanted <= walked + length && out.size() < most) {
      out.push_back(line[i - 1] + ((wanted - walked) / length) * step);
      wanted += spacing;
    }
    walked += length;
  }
  return out;
}

// Centroids of the rings, tip first, skew ones left out; each triangle is shared between two rings.
Line RingCentroids(std::span<const Eigen::Vector3d> points,
                   std::span<const mesh::Triangle> triangles, const Extremities& extremities,
                   const Limb& limb) {
  std::vector<Eigen::Vector3d> moments(kRings, Eigen::Vector3d::Zero());
  std::vector<double> areas(kRings, 0.0);
  const double reach = std::max(limb.tip_distance - limb.junction, 1e-9);
  for (const mesh::Triangle& t : triangles) {
    const double distance =
        (extremities.distance[t[0]] + extremities.distance[t[1]] + extremities.distance[t[2]]) /
        3.0;
    const double at = (limb.tip_distance - distance) / reach * (kRings - 1);
    if (at < 0.0 || at > kRings - 1) continue;
    const int ring = std::min(static_cast<int>(at), kRings - 2);
    const double share = at - ring;
    const Eigen::Vector3d ab = points[t[1]] - points[t[0]];
    const Eigen::Vector3d ac = points[t[2]] - points[t[0]];
    const double area = ab.cross(ac).norm();
    const Eigen::Vector3d middle = points[t[0]] + (ab + ac) / 3.0;
    moments[ring] += (1.0 - share) * area * middle;
    areas[ring] += (1.0 - share) * area;
    moments[ring + 1] += share * area * middle;
    areas[ring + 1] += share * area;
  }
  Line line = {points[limb.tip]};
  for (int i = 1; i < static_cast<int>(kRings * (1.0 - kSkewShare)); ++i) {
    if (areas[i] > 0.0) line.push_back(moments[i] / areas[i]);
  }
  return line;
}

void Extend(Line& line, double length) {
  const std::size_t back = std::min<std::size_t>(4, line.size() - 1);
  const Eigen::Vector3d direction = (line.back() - line[line.size() - 1 - back]).normalized();
  line.push_back(line.back() + length * direction);
}

std::vector<mesh::Triangle> LimbTriangles(std::span<const mesh::Triangle> triangles,
                                          std::span<const char> in_limb) {
  std::vector<mesh::Triangle> own;
  for (const mesh::Triangle& t : triangles) {
    if (in_limb[t[0]] & in_limb[t[1]] & in_limb[t[2]]) own.push_back(t);
  }
  return own;
}

// Sections along the line from the tip until they leave the limb. Before `surely_limb` (an arc), a
// section that does is one across fingers, toes or a sharp bend: it is left out.
std::vector<Station> CutAlong(const CutSurface& surface, const Line& line, double stature,
                              double spacing, double surely_limb) {
  const Line at = Resample(line, kFirstStation * stature, spacing * stature,
                           static_cast<std::size_t>(kLongestLimb / spacing));
  std::vector<Station> stations;
  const int count = static_cast<int>(at.size());
  const int reach = static_cast<int>(std::lround(kChord / spacing));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d& before = at[std::max(0, i - reach)];
    const Eigen::Vector3d& after = at[std::min(count - 1, i + reach)];
    const CutPlane plane = {at[i], (after - before).normalized()};
    const auto loop = surface.CutNearest(plane, kMinGirth * stature);
    const double arc = (kFirstStation + spacing * i) * stature;
    if (!loop || (loop->centroid - at[i]).norm() > kMaxDrift * stature) {
      if (arc < surely_limb) continue;
      break;
    }
    if (arc >= surely_limb && !stations.empty() &&
        loop->girth > (1.0 + kGrowth * spacing) * stations.back().girth)
      break;
    stations.push_back({arc, loop->centroid, plane.normal, loop->girth, std::abs(loop->area)});
  }
  return stations;
}

}  // namespace

Station LimbProfile::At(double arc) const {
  if (!(arc > stations.front().arc)) return stations.front();  // also what is not a number
  if (!(arc < stations.back().arc)) return stations.back();
  const auto after = std::lower_bound(stations.begin(), stations.end(), arc,
                                      [](const Station& s, double a) { return s.arc < a; });
  const Station& b = *after;
  const Station& a = *(after - 1);
  const double t = (arc - a.arc) / (b.arc - a.arc);
  return {arc, a.center + t * (b.center - a.center),
          (a.normal + t * (b.normal - a.normal)).normalized(), a.girth + t * (b.girth - a.girth),
          a.area + t * (b.area - a.area)};
}

double LimbProfile::NearestArc(const Eigen::Vector3d& point) const {
  double best = std::numeric_limits<double>::infinity();
  double arc = 0.0;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const Eigen::Vector3d step = stations[i + 1].center - stations[i].center;
    const double t = std::clamp(
        (point - stations[i].center).dot(step) / std::max(step.squaredNorm(), 1e-18), 0.0, 1.0);
    const double distance = (stations[i].center + t * step - point).norm();
    if (distance >= best) continue;
    best = distance;
    arc = stations[i].arc + t * (stations[i + 1].arc - stations[i].arc);
  }
  return arc;
}

double LimbProfile::ArcTo(const Eigen::Vector3d& point) const {
  const double nearest = NearestArc(point);
  if (nearest < end()) return nearest;
  return nearest + (point - stations.back().center).norm();
}

double LimbProfile::Extreme(double from, double to, double sign) const {
  int best = -1;
  const int count = static_cast<int>(stations.size());
  for (int i = 0; i < count; ++i) {
    if (stations[i].arc < from || stations[i].arc > to) continue;
    if (best < 0 || sign * stations[i].girth < sign * stations[best].girth) best = i;
  }
  if (best < 0) return std::clamp(0.5 * (from + to), stations.front().arc, stations.back().arc);
  if (best == 0 || best + 1 == count) return stations[best].arc;
  // Parabola through three neighbours.
  const double left = sign * stations[best - 1].girth;
  const double right = sign * stations[best + 1].girth;
  const double curvature = left - 2.0 * sign * stations[best].girth + right;
  const double shift = curvature > 0.0 ? 0.5 * (left - right) / curvature : 0.0;
  const double spacing = 0.5 * (stations[best + 1].arc - stations[best - 1].arc);
  return stations[best].arc + std::clamp(shift, -0.5, 0.5) * spacing;
}

double LimbProfile::MaxGirth(double from, double to) const {
  double girth = 0.0;
  for (const Station& s : stations) {
    if (s.arc >= from && s.arc <= to) girth = std::max(girth, s.girth);
  }
  return girth;
}

LimbProfile MakeLimbProfile(std::span<const Eigen::Vector3d> points,
                            std::span<const mesh::Triangle> triangles,
                            const Extremities& extremities, const Limb& limb, double stature) {
  std::vector<char> in_limb(points.size(), 0);
  for (const std::uint32_t v : limb.vertices) in_limb[v] = 1;
  Line line = RingCentroids(points, LimbTriangles(triangles, in_limb), extremities, limb);
  LimbProfile profile;
  if (line.size() < 8) return profile;
  SmoothLine(line, 4);
  const double surely_limb = kSureShare * LengthOf(line);
  Extend(line, kExtension * stature);
  const Eigen::Vector3d inner_end = line.back();
  const double reach = kTrunkReach * stature;
  for (std::size_t v = 0; v < points.size(); ++v) {
    in_limb[v] |= (points[v] - inner_end).squaredNorm() <= reach * reach;
  }
  const std::vector<mesh::Triangle> own = LimbTriangles(triangles, in_limb);
  const CutSurface surface(points, own);
  Line centers = {points[limb.tip]};
  for (const Station& s : CutAlong(surface, line, stature, kDraftSpacing, surely_limb)) {
    centers.push_back(s.center);
  }
  if (centers.size() < 8) return profile;
  SmoothLine(centers, 2);
  Extend(centers, kExtension * stature);
  profile.stations = CutAlong(surface, centers, stature, kSpacing, surely_limb);
  return profile;
}

}  // namespace capfit::body
