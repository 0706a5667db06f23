#include "core/body/skeleton_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace capfit::body {
namespace {

enum class JointSide { kMiddle, kLeft, kRight };

// A name without prefixes, separators, case and side: "lowerarm" of the left.
struct PlainName {
  std::string word;
  JointSide side = JointSide::kMiddle;
};

bool IsLower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool IsUpper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool IsAlnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// "mixamorig:LeftForeArm" to mixamorig, left, fore, arm; numbers are tokens of their own.
std::vector<std::string> Tokens(std::string_view name) {
  std::vector<std::string> tokens;
  bool begins = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!IsAlnum(c)) {
      begins = true;
      continue;
    }
    const char before = i > 0 ? name[i - 1] : ' ';
    const bool ends_capitals =
        IsUpper(c) && IsUpper(before) && i + 1 < name.size() && IsLower(name[i + 1]);
    const bool is_hump = IsUpper(c) && IsLower(before);
    if (begins || is_hump || ends_capitals || IsDigit(c) != IsDigit(before)) tokens.emplace_back();
    tokens.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    begins = false;
  }
  return tokens;
}

// Words that say whose bone or what kind of thing it is, not which.
bool IsDecoration(const std::string& token) {
  static constexpr std::array<std::string_view, 20> kDecorations = {
      "mixamorig", "j", "bip", "biped",    "def", "org",  "jnt",  "joint", "bone", "c",
      "m",         "f", "avg", "armature", "rig", "skel", "char", "bn",    "sk",   "valvebiped"};
  return std::find(kDecorations.begin(), kDecorations.end(), token) != kDecorations.end();
}

// Nothing where a number beyond 1 says that it is a later bone of a chain: lowerarm02.
std::optional<PlainName> PlainNameOf(std::string_view name) {
  PlainName plain;
  bool has_word = false;
  for (const std::string& token : Tokens(name)) {
    if (token == "left" || token == "l") {
      plain.side = JointSide::kLeft;
    } else if (token == "right" || token == "r") {
      plain.side = JointSide::kRight;
    } else if (IsDigit(token[0])) {
      const bool is_first = token.find_first_not_of('0') == std::string::npos ||
                            token.substr(token.find_first_not_of('0')) == "1";
      if (has_word && !is_first) return std::nullopt;
    } else if (!IsDecoration(token)) {
      plain.word += token;
      has_word = true;
    }
  }
  return plain;
}

// The words for the start of a bone at each joint, the surest first.
struct JointWords {
  LandmarkId left;  // or the one in the middle
  std::span<const std::string_view> words;
};

using Word = std::string_view;
constexpr std::array<Word, 5> kShoulderWords = {"upperarm", "uparm", "armupper", "arm", "shoulder"};
constexpr std::array<Word, 4> kElbowWords = {"elbow", "forearm", "lowerarm", "armlower"};
constexpr std::array<Word, 2> kWristWords = {"wrist", "hand"};
constexpr std::array<Word, 7> kHipWords = {"upleg", "upperleg", "thigh", "legupper",
                                           "hip",   "hipjoint", "leg"};
constexpr std::array<Word, 6> kKneeWords = {"knee", "lowerleg", "calf", "shin", "leglower", "leg"};
constexpr std::array<Word, 2> kAnkleWords = {"ankle", "foot"};
constexpr std::array<Word, 1> kNeckWords = {"neck"};
// Knees come before hips: "leg" is a shin where no better word for one is found.
constexpr std::array<JointWords, 7> kJointWords = {{{LandmarkId::kLeftShoulder, kShoulderWords},
                                                    {LandmarkId::kLeftElbow, kElbowWords},
                                                    {LandmarkId::kLeftWrist, kWristWords},
                                                    {LandmarkId::kLeftKnee, kKneeWords},
                                                    {LandmarkId::kLeftHip, kHipWords},
                                                    {LandmarkId::kLeftAnkle, kAnkleWords},
                                                    {LandmarkId::kNeck, kNeckWords}}};

class SkeletonReader {
 public:
  explicit SkeletonReader(const std::vector<formats::NamedJoint>& joints) : joints_(joints) {
    names_.reserve(joints.size());
    for (const formats::NamedJoint& joint : joints) names_.push_back(PlainNameOf(joint.name));
  }

  std::map<LandmarkId, Eigen::Vector3d> Run() && {
    std::map<LandmarkId, Eigen::Vector3d> landmarks;
    std::vector<char> is_taken(joints_.size(), 0);
    for (const JointWords& entry : kJointWords) {
      const bool is_pair = MirrorLandmark(entry.left) != entry.left;
      for (const JointSide side : {JointSide::kMiddle, JointSide::kLeft, JointSide::kRight}) {
        if (is_pair == (side == JointSide::kMiddle)) continue;
        const auto joint = Find(entry.words, side, is_taken);
        if (!joint) continue;
        is_taken[*joint] = 1;
        const LandmarkId id = side == JointSide::kRight ? MirrorLandmark(entry.left) : entry.left;
        if (joints_[*joint].position.allFinite()) landmarks[id] = joints_[*joint].position;
      }
    }
    return landmarks;
  }

 private:
  [[nodiscard]] std::optional<std::size_t> Find(std::span<const std::string_view> words,
                                                JointSide side,
                                                const std::vector<char>& is_taken) const {
    for (const std::string_view word : words) {
      for (std::size_t i = 0; i < names_.size(); ++i) {
        if (is_taken[i] || !names_[i] || names_[i]->side != side) continue;
        if (names_[i]->word == word) return i;
      }
    }
    return std::nullopt;
  }

  const std::vector<formats::NamedJoint>& joints_;
  std::vector<std::optional<PlainName>> names_;
};

}  // namespace

std::map<LandmarkId, Eigen::Vector3d> LandmarksFromSkeleton(
    const std::vector<formats::NamedJoint>& joints) {
  return SkeletonReader(joints).Run();
}

}  // namespace capfit::body
