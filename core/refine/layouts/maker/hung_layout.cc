#include "core/refine/layouts/maker/hung_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kAlongDigit = 0.01;   // in bone lengths
constexpr double kRadiusDigit = 0.01;  // all else, in bone radii
constexpr double kLeastRadius = 0.1;

double Rounded(double x, double digit) { return std::round(x / digit) * digit; }

// The bone that the node is nearest to on all bodies, in the bone's radii.
BoneId NearestBone(std::span<const Subject> subjects, const Graphs& graphs, int v) {
  BoneId nearest = BoneId::kBelly;
  double least = std::numeric_limits<double>::max();
  for (int b = 0; b < (graphs[0].IsOnPlane(v) ? kMidBoneCount : kBoneCount); ++b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      sum += subjects[k].skeleton.DistanceInRadii(static_cast<BoneId>(b), Side::kLeft,
                                                  graphs[k].sphere(v).center_m);
    }
    if (sum < least) least = sum, nearest = static_cast<BoneId>(b);
  }
  return nearest;
}

LayoutNode NodeOf(std::span<const Subject> subjects, const Graphs& graphs, int v) {
  const bool on_plane = graphs[0].IsOnPlane(v);
  const BoneId bone = NearestBone(subjects, graphs, v);
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < graphs.size(); ++k) {
    const Skeleton& skeleton = subjects[k].skeleton;
    const geometry::Sphere& node = graphs[k].sphere(v);
    const BonePlace place = *skeleton.PlaceOf(bone, Side::kLeft, node.center_m);
    const double radius = node.radius_m / skeleton.bone(bone, Side::kLeft)->radius_m;
    mean += Eigen::Vector4d(place.along, place.aside, place.ahead, radius);
  }
  mean /= static_cast<double>(graphs.size());
  const double aside = on_plane ? 0.0 : Rounded(mean[1], kRadiusDigit);
  return {bone,
          {Rounded(mean[0], kAlongDigit), aside, Rounded(mean[2], kRadiusDigit)},
          std::max(kLeastRadius, Rounded(mean[3], kRadiusDigit)),
          !on_plane};
}

}  // namespace

HungLayout LayoutOf(std::span<const Subject> subjects, const Graphs& graphs) {
  const capsule::MirroredSet& first = graphs[0];
  HungLayout layout;
  std::vector<std::uint8_t> row(first.spheres().size(), 0);
  std::vector<char> is_right(first.spheres().size(), 0);
  for (int v = 0; v < first.sphere_count(); ++v) {
    if (!first.IsRepresentative(v)) continue;
    const int image = first.ImageOf(v);
    // The left one stands for a pair.
    const bool is_left = first.IsOnPlane(v) || first.sphere(v).center_m.x() >= 0.0;
    row[v] = row[image] = static_cast<std::uint8_t>(layout.nodes.size());
    if (!first.IsOnPlane(v)) is_right[is_left ? image : v] = 1;
    layout.nodes.push_back(NodeOf(subjects, graphs, is_left ? v : static_cast<int>(image)));
  }
  for (int e = 0; e < first.capsule_count(); ++e) {
    if (!first.IsCapsuleRepresentative(e)) continue;
    const auto [a, b] = first.ends(e);
    const bool crossed = !first.IsOnPlane(a) && !first.IsOnPlane(b) && is_right[a] != is_right[b];
    const auto [low, high] = std::minmax(row[a], row[b]);
    layout.edges.push_back({low, high, crossed});
  }
  return layout;
}

void Print(const HungLayout& layout) {
  static constexpr const char* kNames[kBoneCount] = {
      "kBelly", "kRibs",   "kChest", "kHead", "kClavicle", "kUpperArm", "kForearm",
      "kHand",  "kPelvis", "kThigh", "kShin", "kFoot",     "kHeel"};
  for (std::size_t i = 0; i < layout.nodes.size(); ++i) {
    const LayoutNode& n = layout.nodes[i];
    std::printf("    {BoneId::%s, {%.2f, %.2f, %.2f}, %.2f, %s},  // %zu\n",
                kNames[static_cast<int>(n.bone)], n.place.along, n.place.aside, n.place.ahead,
                n.radius, n.paired ? "true" : "false", i);
  }
  for (const LayoutEdge& e : layout.edges) {
    std::printf("    {%d, %d, %s},\n", e.a, e.b, e.crossed ? "true" : "false");
  }
}

}  // namespace capfit::refine
