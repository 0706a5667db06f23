// The words for a body: segments, chains, landmarks and the groups a caller can ask for.
#ifndef CAPFIT_CORE_BODY_ANATOMY_H_
#define CAPFIT_CORE_BODY_ANATOMY_H_

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace capfit::body {

// Which piece of the body a vertex belongs to. "Left" is the body's own left, +X in the body frame.
enum class Segment : std::uint8_t {
  kTorso,
  kHead,
  kLeftUpperArm,
  kLeftForearm,
  kLeftHand,
  kRightUpperArm,
  kRightForearm,
  kRightHand,
  kLeftThigh,
  kLeftCalf,
  kLeftFoot,
  kRightThigh,
  kRightCalf,
  kRightFoot,
  kNeck
};
inline constexpr int kSegmentCount = 15;

// The five tubes that feature polygons are cut from (paper, III-C), and the four kinds of blob that
// one ball stands for. The torso chain includes the neck up to its middle.
enum class Part : std::uint8_t {
  kTorso,
  kLeftArm,
  kRightArm,
  kLeftLeg,
  kRightLeg,
  kHead,
  kLeftHand,
  kRightHand,
  kLeftFoot,
  kRightFoot
};
inline constexpr int kPartCount = 10;
inline constexpr int kChainCount = 5;  // the first five parts are chains

// "torso", "left_arm", ...: the words in results.
[[nodiscard]] std::string_view PartName(Part part);
[[nodiscard]] std::optional<Part> PartFromName(std::string_view name);
[[nodiscard]] Part PartOf(Segment segment);  // neck counts as torso
// "torso", "left_upper_arm", ...: one for each segment.
[[nodiscard]] std::string_view SegmentName(Segment segment);

// The part on the other side; itself for torso and head.
[[nodiscard]] Part MirrorPart(Part part);

// What the caller may switch on and off.
struct PartSelection {
  bool torso = true;
  bool arms = true;
  bool legs = true;
  bool head = false;
  bool hands = false;
  bool feet = false;
  [[nodiscard]] bool Includes(Part part) const;
  [[nodiscard]] friend bool operator==(const PartSelection&, const PartSelection&) = default;
};

// The parts that segments belong to, by Part. O(segments), about 10 microseconds for 100,000.
[[nodiscard]] std::array<bool, kPartCount> PartsAmong(std::span<const Segment> segments);
// Whether one of them is not selected.
[[nodiscard]] bool LeavesOutSome(std::span<const Segment> segments, const PartSelection& parts);

enum class LandmarkId : std::uint8_t {
  kHeadTop,
  kNeck,
  kCrotch,
  kWaist,
  kBust,
  kHip,  // kWaist, kBust, kHip: centres of those sections
  kLeftArmpit,
  kRightArmpit,
  kLeftShoulder,
  kRightShoulder,
  kLeftElbow,
  kRightElbow,
  kLeftWrist,
  kRightWrist,
  kLeftHip,
  kRightHip,
  kLeftKnee,
  kRightKnee,
  kLeftAnkle,
  kRightAnkle,
  kLeftFingertip,
  kRightFingertip,
  kLeftToe,
  kRightToe,
  kLeftHeel,
  kRightHeel
};
inline constexpr int kLandmarkCount = 26;

// "left_wrist", "head_top", "left_middle_fingertip", "left_big_toe_tip", "left_heel", ...
[[nodiscard]] std::string_view LandmarkName(LandmarkId id);
// All of them, with ", " between.
[[nodiscard]] std::string LandmarkNames();
[[nodiscard]] std::optional<LandmarkId> LandmarkFromName(std::string_view name);
[[nodiscard]] LandmarkId MirrorLandmark(LandmarkId id);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_ANATOMY_H_
