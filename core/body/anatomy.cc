#include "core/body/anatomy.h"

#include <algorithm>
#include <cstddef>

#include "absl/strings/str_join.h"
#include "core/base/enum_index.h"

namespace capfit::body {
namespace {

constexpr std::array<std::string_view, kPartCount> kPartNames = {
    "torso", "left_arm",  "right_arm",  "left_leg",  "right_leg",
    "head",  "left_hand", "right_hand", "left_foot", "right_foot"};

constexpr std::array<std::string_view, kSegmentCount> kSegmentNames = {
    "torso",           "head",          "left_upper_arm", "left_forearm", "left_hand",
    "right_upper_arm", "right_forearm", "right_hand",     "left_thigh",   "left_calf",
    "left_foot",       "right_thigh",   "right_calf",     "right_foot",   "neck"};

constexpr std::array<std::string_view, kLandmarkCount> kLandmarkNames = {"head_top",
                                                                         "neck",
                                                                         "crotch",
                                                                         "waist",
                                                                         "bust",
                                                                         "hip",
                                                                         "left_armpit",
                                                                         "right_armpit",
                                                                         "left_shoulder",
                                                                         "right_shoulder",
                                                                         "left_elbow",
                                                                         "right_elbow",
                                                                         "left_wrist",
                                                                         "right_wrist",
                                                                         "left_hip",
                                                                         "right_hip",
                                                                         "left_knee",
                                                                         "right_knee",
                                                                         "left_ankle",
                                                                         "right_ankle",
                                                                         "left_middle_fingertip",
                                                                         "right_middle_fingertip",
                                                                         "left_big_toe_tip",
                                                                         "right_big_toe_tip",
                                                                         "left_heel",
                                                                         "right_heel"};

}  // namespace

std::string_view PartName(Part part) { return kPartNames[Index(part)]; }

std::optional<Part> PartFromName(std::string_view name) {
  const auto found = std::find(kPartNames.begin(), kPartNames.end(), name);
  if (found == kPartNames.end()) return std::nullopt;
  return static_cast<Part>(found - kPartNames.begin());
}

std::string_view SegmentName(Segment segment) { return kSegmentNames[Index(segment)]; }

Part PartOf(Segment segment) {
  switch (segment) {
    case Segment::kTorso:
    case Segment::kNeck:
      return Part::kTorso;
    case Segment::kHead:
      return Part::kHead;
    case Segment::kLeftUpperArm:
    case Segment::kLeftForearm:
      return Part::kLeftArm;
    case Segment::kLeftHand:
      return Part::kLeftHand;
    case Segment::kRightUpperArm:
    case Segment::kRightForearm:
      return Part::kRightArm;
    case Segment::kRightHand:
      return Part::kRightHand;
    case Segment::kLeftThigh:
    case Segment::kLeftCalf:
      return Part::kLeftLeg;
    case Segment::kLeftFoot:
      return Part::kLeftFoot;
    case Segment::kRightThigh:
    case Segment::kRightCalf:
      return Part::kRightLeg;
    case Segment::kRightFoot:
      return Part::kRightFoot;
  }
  return Part::kTorso;
}

Part MirrorPart(Part part) {
  if (part == Part::kTorso || part == Part::kHead) return part;
  // Left and right follow each other: arms 1 2, legs 3 4, hands 6 7, feet 8 9.
  const int index = static_cast<int>(part);
  const bool is_left = part < Part::kHead ? index % 2 == 1 : index % 2 == 0;
  return static_cast<Part>(is_left ? index + 1 : index - 1);
}

bool PartSelection::Includes(Part part) const {
  switch (part) {
    case Part::kTorso:
      return torso;
    case Part::kLeftArm:
    case Part::kRightArm:
      return arms;
    case Part::kLeftLeg:
    case Part::kRightLeg:
      return legs;
    case Part::kHead:
      return head;
    case Part::kLeftHand:
    case Part::kRightHand:
      return hands;
    case Part::kLeftFoot:
    case Part::kRightFoot:
      return feet;
  }
  return false;
}

std::string_view LandmarkName(LandmarkId id) { return kLandmarkNames[Index(id)]; }

std::string LandmarkNames() {
  const auto append = [](std::string* names, std::string_view name) { names->append(name); };
  return absl::StrJoin(kLandmarkNames, ", ", append);
}

std::optional<LandmarkId> LandmarkFromName(std::string_view name) {
  for (std::size_t i = 0; i < kLandmarkNames.size(); ++i) {
    if (kLandmarkNames[i] == name) return static_cast<LandmarkId>(i);
  }
  return std::nullopt;
}

LandmarkId MirrorLandmark(LandmarkId id) {
  const int index = static_cast<int>(id);
  const int first_pair = static_cast<int>(LandmarkId::kLeftArmpit);
  if (index < first_pair) return id;
  return static_cast<LandmarkId>((index - first_pair) % 2 == 0 ? index + 1 : index - 1);
}

std::array<bool, kPartCount> PartsAmong(std::span<const Segment> segments) {
  std::uint32_t bits = 0;  // by segment; free of branches, so that it vectorises
  for (const Segment segment : segments) bits |= 1u << static_cast<std::uint32_t>(segment);
  std::array<bool, kPartCount> has_part{};
  for (std::size_t s = 0; s < kSegmentCount; ++s) {
    if ((bits >> s & 1u) != 0) has_part[Index(PartOf(static_cast<Segment>(s)))] = true;
  }
  return has_part;
}

bool LeavesOutSome(std::span<const Segment> segments, const PartSelection& parts) {
  const std::array<bool, kPartCount> has_part = PartsAmong(segments);
  for (std::size_t p = 0; p < has_part.size(); ++p) {
    if (has_part[p] && !parts.Includes(static_cast<Part>(p))) return true;
  }
  return false;
}

}  // namespace capfit::body
