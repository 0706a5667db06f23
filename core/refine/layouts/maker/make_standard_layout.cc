// Makes a table of core/refine/layouts/standard_layouts.cc: the layout of the tight fit of the
// whole built-in mannequin, with its arms lifted to 75 degrees.
//
//   make_standard_layout SPHERES        as many capsules
//
// Prints spheres and capsules as they stand in the table, to be copied. (The fit that it makes them
// of starts from the table that is there as well: of 32 spheres the same table may come out again.)
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/enum_index.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"

namespace capfit {
namespace {

// The arms apart from the trunk, so that no sphere serves both: on 41 bodies and avatars this one's
// layout was the best of 58, and made for none of them.
constexpr double kArmAngle = 75.0 * std::numbers::pi / 180.0;

std::string Word(body::Part part) {
  std::string word = "k";
  bool is_first = true;
  for (const char c : std::string(body::PartName(part))) {
    if (c == '_') {
      is_first = true;
      continue;
    }
    word += is_first ? static_cast<char>(c - 'a' + 'A') : c;
    is_first = false;
  }
  return word;
}

std::string Word(refine::BoneId bone) {
  static constexpr const char* kNames[refine::kBoneCount] = {
      "kBelly", "kRibs",   "kChest", "kHead", "kClavicle", "kUpperArm", "kForearm",
      "kHand",  "kPelvis", "kThigh", "kShin", "kFoot",     "kHeel"};
  return kNames[static_cast<int>(bone)];
}

// From the trunk outward, left before right: 1 for a name with "left" in it, 2 for "right".
std::tuple<int, std::string, int> RankOf(const refine::KeptSphere& sphere) {
  static constexpr std::array<int, body::kPartCount> kOrder = {0, 2, 2, 4, 4, 1, 3, 3, 5, 5};
  std::string name = sphere.name;
  int side = 0;
  for (const char* word : {"left_", "right_"}) {
    ++side;
    const std::size_t at = name.find(word);
    if (at == std::string::npos) continue;
    name.erase(at, std::string(word).size());
    return {kOrder[Index(sphere.part)], name, side};
  }
  return {kOrder[Index(sphere.part)], name, 0};
}

refine::KeptLayout InOrder(const refine::KeptLayout& layout) {
  std::vector<int> order(layout.spheres.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int i) -> const refine::KeptSphere& { return layout.spheres[i]; };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return RankOf(at(a)) < RankOf(at(b)); });
  std::vector<int> index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    index[order[i]] = static_cast<int>(i);
  }
  refine::KeptLayout sorted;
  for (const int i : order) {
    sorted.spheres.push_back(at(i));
    int& mirror = sorted.spheres.back().mirror;
    if (mirror >= 0) mirror = index[mirror];
  }
  for (const capsule::CapsuleEnds& ends : layout.capsules) {
    const auto [a, b] = std::minmax(index[ends[0]], index[ends[1]]);
    sorted.capsules.push_back({a, b});
  }
  std::sort(sorted.capsules.begin(), sorted.capsules.end());
  return sorted;
}

void Print(const refine::KeptLayout& layout) {
  int index = 0;
  for (const refine::KeptSphere& sphere : layout.spheres) {
    const refine::BodyPlace& at = *sphere.place;
    std::printf(
        "    {\"%s\", Part::%s, %d, BoneId::%s, Side::%s, {%.2f, %.2f, %.2f}, %.2f},  // %d\n",
        sphere.name.c_str(), Word(sphere.part).c_str(), sphere.mirror, Word(at.bone).c_str(),
        at.side == refine::Side::kLeft ? "kLeft" : "kRight", at.place.along, at.place.aside,
        at.place.ahead, at.radius, index++);
  }
  for (const capsule::CapsuleEnds& ends : layout.capsules) {
    std::printf("    {%d, %d},\n", ends[0], ends[1]);
  }
}

int Main(int spheres) {
  mannequin::MannequinOptions figure;
  figure.arm_angle_rad = kArmAngle;
  const auto soup = mannequin::MakeMannequin(figure);
  if (!soup.ok()) return 1;
  pipeline::FitOptions options;
  options.quality = pipeline::Quality::kTight;
  options.parts = {true, true, true, true, true, true};
  options.max_spheres = spheres;
  options.max_capsules = spheres;
  const ThreadPool pool(0);
  NullObserver observer;
  const auto result = pipeline::Fit(*soup, options, pool, observer);
  if (!result.ok()) {
    std::fprintf(stderr, "%s\n", result.status().ToString().c_str());
    return 1;
  }
  Print(InOrder(LayoutOf(*result)));
  return 0;
}

}  // namespace
}  // namespace capfit

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_standard_layout SPHERES\n");
    return 2;
  }
  return capfit::Main(std::atoi(argv[1]));
}
