#include "core/pipeline/sphere_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "absl/strings/str_cat.h"

namespace capfit::pipeline {
namespace {

using body::LandmarkId;
using body::Part;
using Vec3 = Eigen::Vector3d;

// Spheres without an image count as central up to this far from the middle, relative to the body's
// height.
constexpr double kCentral = 0.01;
// A neck is this much of the way to the shoulders wide.
constexpr double kNeckShare = 0.5;

enum class Side { kNone, kLeft, kRight };

std::string Word(Side side) { return side == Side::kLeft ? "left" : "right"; }

// Where a sphere lies; spheres of one place are counted.
struct Place {
  std::string region;    // "chest", "upper_arm"
  bool is_limb = false;  // the side comes first
  Side side = Side::kNone;
  std::array<double, 4> order{};  // along the count; what is equal in the first goes by the next
};

std::string NameOf(const Place& place, int number) {
  if (place.side == Side::kNone) return absl::StrCat(place.region, "_", number);
  if (place.is_limb) return absl::StrCat(Word(place.side), "_", place.region, "_", number);
  return absl::StrCat(place.region, "_", Word(place.side), "_", number);
}

bool IsSided(Part part) { return body::MirrorPart(part) != part; }

// Each left part comes just before its right one.
bool IsLeft(Part part) { return part < body::MirrorPart(part); }

Side SideOf(Part part) { return IsLeft(part) ? Side::kLeft : Side::kRight; }

class Namer {
 public:
  explicit Namer(const body::Body& body) : body_(body) {
    const auto crotch = At(LandmarkId::kCrotch);
    const auto neck = At(LandmarkId::kNeck);
    if (crotch && neck && (*neck - *crotch).norm() > 0.0) trunk_ = (*neck - *crotch).normalized();
    AddAnchor("pelvis", At(LandmarkId::kHip));
    AddAnchor("waist", At(LandmarkId::kWaist));
    AddAnchor("chest", At(LandmarkId::kBust));
    AddAnchor("shoulder", Middle(LandmarkId::kLeftShoulder, LandmarkId::kRightShoulder));
    AddAnchor("neck", neck);
    const auto shoulder = At(LandmarkId::kLeftShoulder);
    if (shoulder) neck_width_m_ = kNeckShare * std::abs(shoulder->x());
  }

  // `side`: of a part without sides of its own.
  [[nodiscard]] Place PlaceOf(const Vec3& center_m, Part part, Side side) const {
    Place place = IsSided(part) ? OnLimb(center_m, part) : OnTrunk(center_m, part, side);
    place.order[2] = center_m.z();
    place.order[3] = std::abs(center_m.x());
    return place;
  }

  [[nodiscard]] Side SideByPlace(const Vec3& center_m) const {
    if (std::abs(center_m.x()) <= kCentral * body_.height_m) return Side::kNone;
    return center_m.x() > 0.0 ? Side::kLeft : Side::kRight;
  }

 private:
  [[nodiscard]] std::optional<Vec3> At(LandmarkId id) const {
    if (!body_.landmark(id)) return std::nullopt;
    return body_.landmark(id)->position_m;
  }

  [[nodiscard]] std::optional<Vec3> Middle(LandmarkId a, LandmarkId b) const {
    const auto one = At(a);
    const auto other = At(b);
    if (one && other) return 0.5 * (*one + *other);
    return one ? one : other;
  }

  [[nodiscard]] double Along(const Vec3& point_m) const { return trunk_.dot(point_m); }

  void AddAnchor(std::string region, const std::optional<Vec3>& at) {
    if (at) anchors_.emplace_back(Along(*at), std::move(region));
  }

  [[nodiscard]] Place OnTrunk(const Vec3& center_m, Part part, Side side) const {
    Place place;
    place.side = side;
    place.order[0] = Along(center_m);
    place.order[1] = center_m.y();
    place.region = "torso";
    if (part == Part::kHead) {
      place.region = "head";
      return place;
    }
    double least = HUGE_VAL;
    for (const auto& [along, region] : anchors_) {
      const double distance = std::abs(along - place.order[0]);
      const bool is_wide = region == "neck" && std::abs(center_m.x()) > neck_width_m_;
      if (distance >= least || is_wide) continue;
      least = distance;
      place.region = region;
    }
    return place;
  }

  [[nodiscard]] Place OnLimb(const Vec3& center_m, Part part) const {
    Place place;
    place.is_limb = true;
    place.side = SideOf(part);
    const Part left = IsLeft(part) ? part : body::MirrorPart(part);
    const auto landmark = [&](LandmarkId id) {
      return At(place.side == Side::kLeft ? id : body::MirrorLandmark(id));
    };
    switch (left) {
      case Part::kLeftHand:
        place.region = "hand";
        Count(landmark(LandmarkId::kLeftWrist), center_m, place);
        break;
      case Part::kLeftFoot:
        place.region = "foot";
        Count(landmark(LandmarkId::kLeftAnkle), center_m, place);
        break;
      case Part::kLeftArm:
        place.region = "arm";
        Cut(part, landmark(LandmarkId::kLeftElbow), {"upper_arm", "forearm"}, center_m, place);
        break;
      default:
        place.region = "leg";
        Cut(part, landmark(LandmarkId::kLeftKnee), {"thigh", "calf"}, center_m, place);
    }
    return place;
  }

  // By the distance from where the piece begins; downward where that is not known.
  static void Count(const std::optional<Vec3>& begin, const Vec3& center_m, Place& place) {
    place.order[0] = begin ? (center_m - *begin).norm() : 0.0;
    place.order[1] = -center_m.y();
  }

  // The half of the limb on this side of its middle joint or beyond, along the limb's curve.
  void Cut(Part chain, const std::optional<Vec3>& joint, const std::array<const char*, 2>& halves,
           const Vec3& center_m, Place& place) const {
    const std::optional<body::MedialCurve>& curve = body_.chain(chain);
    if (!curve) return Count(std::nullopt, center_m, place);
    place.order[0] = curve->Project(center_m);
    // Beyond an end of the curve all are at that end.
    place.order[1] = (center_m - curve->points_m.front()).norm();
    if (joint) place.region = halves[place.order[0] > curve->Project(*joint) ? 1 : 0];
  }

  const body::Body& body_;
  Vec3 trunk_ = Vec3::UnitY();
  std::vector<std::pair<double, std::string>> anchors_;  // along the trunk
  double neck_width_m_ = HUGE_VAL;                       // to either side
};

// One place for a sphere, or for two that are images of each other.
struct Entry {
  std::size_t sphere = 0;
  std::optional<std::size_t> image;
  Place place;
};

std::optional<std::size_t> ImageOf(const capsule::PrimitiveSet& set, std::size_t index) {
  const int mirror = set.origins[index].mirror;
  if (mirror < 0 || std::cmp_greater_equal(mirror, set.spheres.size())) return std::nullopt;
  if (!std::cmp_equal(set.origins[mirror].mirror, index)) return std::nullopt;
  return mirror;
}

// Whether the sphere speaks for its pair: the left one.
bool IsFirstOfPair(const capsule::PrimitiveSet& set, std::size_t index, std::size_t image) {
  const double x = set.spheres[index].center_m.x();
  const double other = set.spheres[image].center_m.x();
  return x != other ? x > other : index < image;
}

std::vector<Entry> EntriesOf(const body::Body& body, const capsule::PrimitiveSet& set) {
  const Namer namer(body);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    const Vec3& center_m = set.spheres[i].center_m;
    Part part = set.origins[i].part;
    const std::optional<std::size_t> image = ImageOf(set, i);
    if (!image) {
      entries.push_back({i, image, namer.PlaceOf(center_m, part, namer.SideByPlace(center_m))});
      continue;
    }
    if (*image == i) {
      if (IsSided(part)) part = Part::kTorso;  // between the two
      entries.push_back({i, std::nullopt, namer.PlaceOf(center_m, part, Side::kNone)});
      continue;
    }
    if (!IsFirstOfPair(set, i, *image)) continue;
    entries.push_back({i, image, namer.PlaceOf(center_m, part, Side::kLeft)});
  }
  // Pairs first: what is counted on one side only comes behind the numbers of both.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tuple(!a.image, a.place.order) < std::tuple(!b.image, b.place.order);
  });
  return entries;
}

}  // namespace

std::vector<std::string> SphereNames(const body::Body& body, const capsule::PrimitiveSet& set) {
  std::vector<std::string> names(set.spheres.size());
  std::map<std::pair<std::string, Side>, int> counts;
  for (const Entry& entry : EntriesOf(body, set)) {
    Place place = entry.place;
    const int number = ++counts[{place.region, place.side}];
    names[entry.sphere] = NameOf(place, number);
    if (!entry.image) continue;
    place.side = place.side == Side::kLeft ? Side::kRight : Side::kLeft;
    names[*entry.image] = NameOf(place, number);
    counts[{place.region, place.side}] = number;
  }
  return names;
}

}  // namespace capfit::pipeline
