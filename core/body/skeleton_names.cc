#include "core/body/skeleton_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace capfit::body {
namespace {

enum class JointSide { kMiddle, kLeft, kRight };

// A name without prefixes, separators, case and side: "lowerarm" of the left.
struct PlainName {
  std::string word;
  JointSide side = JointSide::kMiddle;

  bool operator<(const PlainName& other) const {
    return std::tie(word, side) < std::tie(other.word, other.side);
  }
};

bool IsLower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool IsUpper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool IsAlnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

bool IsOfOtherScript(char c) { return static_cast<unsigned char>(c) >= 0x80; }

// MikuMikuDance's names are Japanese: the side, then one of these, and nothing more.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kJapaneseWords = {{
    {"腕", "upperarm"},
    {"ひじ", "elbow"},
    {"肘", "elbow"},
    {"手首", "wrist"},
    {"足", "thigh"},
    {"ひざ", "knee"},
    {"膝", "knee"},
    {"足首", "ankle"},
    {"首", "neck"},
    {"頭", "head"},
}};

void AddJapanese(std::string_view word, std::vector<std::string>& tokens) {
  for (const auto& [side, meaning] : {std::pair<std::string_view, const char*>("左", "left"),
                                      std::pair<std::string_view, const char*>("右", "right")}) {
    if (!word.starts_with(side)) continue;
    tokens.emplace_back(meaning);
    word.remove_prefix(side.size());
    break;
  }
  for (const auto& [japanese, meaning] : kJapaneseWords) {
    if (word == japanese) tokens.emplace_back(meaning);
  }
}

// "mixamorig:LeftForeArm" to mixamorig, left, fore, arm; numbers are tokens of their own.
std::vector<std::string> Tokens(std::string_view name) {
  std::vector<std::string> tokens;
  bool begins = true;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (IsOfOtherScript(c)) {
      std::size_t end = i;
      while (end < name.size() && IsOfOtherScript(name[end])) ++end;
      AddJapanese(name.substr(i, end - i), tokens);
      i = end - 1;
      begins = true;
      continue;
    }
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
  static constexpr std::array<std::string_view, 24> kDecorations = {
      "mixamorig", "j",        "bip",  "biped", "def",       "org", "jnt",  "joint",
      "bone",      "c",        "m",    "f",     "avg",       "cc",  "base", "armature",
      "rig",       "skeleton", "skel", "char",  "character", "bn",  "sk",   "valvebiped"};
  return std::find(kDecorations.begin(), kDecorations.end(), token) != kDecorations.end();
}

bool IsSide(const std::string& token) {
  return token == "left" || token == "l" || token == "right" || token == "r";
}
bool IsNumber(const std::string& token) { return IsDigit(token[0]); }

// Where more names than this share of them agree, it is a habit of the file.
constexpr double kHabit = 0.6;
// Of fewer names none can be told.
constexpr std::size_t kFewNames = 8;

// The word that most names begin with is the character's: "Bob:LeftArm", "Bob:Hips".
void DropCommonFirstWord(std::vector<std::vector<std::string>>& names) {
  std::map<std::string, std::size_t> counts;
  std::size_t named = 0;
  for (const std::vector<std::string>& tokens : names) {
    if (tokens.empty()) continue;
    ++named;
    if (tokens.size() > 1 && !IsSide(tokens.front())) ++counts[tokens.front()];
  }
  for (const auto& [word, count] : counts) {
    if (named < kFewNames || static_cast<double>(count) < kHabit * static_cast<double>(named)) {
      continue;
    }
    for (std::vector<std::string>& tokens : names) {
      if (tokens.size() > 1 && tokens.front() == word) tokens.erase(tokens.begin());
    }
    return;
  }
}

// Converters number all nodes of a file: "LeftArm_07", "LeftForeArm_08".
void DropNodeNumbers(std::vector<std::vector<std::string>>& names) {
  std::set<std::string> numbers;
  std::size_t named = 0;
  for (const std::vector<std::string>& tokens : names) {
    if (tokens.empty()) continue;
    ++named;
    if (tokens.size() > 1 && IsNumber(tokens.back())) numbers.insert(tokens.back());
  }
  const bool is_habit = static_cast<double>(numbers.size()) >= kHabit * static_cast<double>(named);
  if (named < kFewNames || !is_habit) return;
  for (std::vector<std::string>& tokens : names) {
    if (tokens.size() > 1 && IsNumber(tokens.back())) tokens.pop_back();
  }
}

// Rigify's spine is numbered up to the neck (4) and the head (6).
void NameTheSpine(std::vector<std::string>& tokens) {
  if (tokens.size() < 2 || tokens[tokens.size() - 2] != "spine") return;
  if (tokens.back() == "004") tokens = {"neck"};
  if (tokens.back() == "006") tokens = {"head"};
}

// Nothing where a number beyond 1 says that it is a later bone of a chain: lowerarm02.
std::optional<PlainName> PlainNameOf(const std::vector<std::string>& tokens) {
  PlainName plain;
  bool has_word = false;
  for (const std::string& token : tokens) {
    if (token == "left" || token == "l") {
      plain.side = JointSide::kLeft;
    } else if (token == "right" || token == "r") {
      plain.side = JointSide::kRight;
    } else if (IsNumber(token)) {
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

using PlainNames = std::vector<std::optional<PlainName>>;

PlainNames PlainNamesOf(const std::vector<formats::NamedJoint>& joints) {
  std::vector<std::vector<std::string>> names;
  names.reserve(joints.size());
  for (const formats::NamedJoint& joint : joints) names.push_back(Tokens(joint.name));
  DropNodeNumbers(names);
  DropCommonFirstWord(names);
  PlainNames plain;
  plain.reserve(names.size());
  for (std::vector<std::string>& tokens : names) {
    NameTheSpine(tokens);
    plain.push_back(PlainNameOf(tokens));
  }
  return plain;
}

// What the file itself says: "leftLowerArm".
PlainNames HumanBonesOf(const std::vector<formats::NamedJoint>& joints) {
  PlainNames plain;
  for (const formats::NamedJoint& joint : joints) {
    plain.push_back(joint.human_bone.empty() ? std::nullopt
                                             : PlainNameOf(Tokens(joint.human_bone)));
  }
  return plain;
}

// The words for the start of a bone at each joint, the surest first.
struct JointWords {
  LandmarkId left;  // or the one in the middle
  std::span<const std::string_view> words;
};

using Word = std::string_view;
constexpr std::array<Word, 7> kShoulderWords = {"upperarm", "uparm", "armupper", "shldrbend",
                                                "shldr",    "arm",   "shoulder"};
constexpr std::array<Word, 5> kElbowWords = {"elbow", "forearm", "lowerarm", "armlower",
                                             "forearmbend"};
constexpr std::array<Word, 2> kWristWords = {"wrist", "hand"};
constexpr std::array<Word, 8> kHipWords = {"upleg", "upperleg", "thigh",     "legupper",
                                           "hip",   "hipjoint", "thighbend", "leg"};
constexpr std::array<Word, 6> kKneeWords = {"knee", "lowerleg", "calf", "shin", "leglower", "leg"};
constexpr std::array<Word, 2> kAnkleWords = {"ankle", "foot"};
constexpr std::array<Word, 3> kNeckWords = {"neck", "necktwist", "necklower"};
constexpr std::array<Word, 1> kHeadWords = {"head"};
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
  explicit SkeletonReader(const std::vector<formats::NamedJoint>& joints)
      : joints_(joints), is_taken_(joints.size(), 0) {}

  // Fills in what is not there yet.
  void Read(const PlainNames& names) {
    const std::map<PlainName, std::size_t> first = FirstByName(names);
    for (const JointWords& entry : kJointWords) {
      const bool is_pair = MirrorLandmark(entry.left) != entry.left;
      for (const JointSide side : {JointSide::kMiddle, JointSide::kLeft, JointSide::kRight}) {
        if (is_pair == (side == JointSide::kMiddle)) continue;
        const LandmarkId id = side == JointSide::kRight ? MirrorLandmark(entry.left) : entry.left;
        if (rig_.landmarks.contains(id)) continue;
        const auto joint = Take(first, entry.words, side);
        if (joint) rig_.landmarks[id] = joints_[*joint].position;
      }
    }
    if (rig_.head) return;
    const auto head = Take(first, kHeadWords, JointSide::kMiddle);
    if (head) rig_.head = joints_[*head].position;
  }

  Rig TakeRig() { return std::move(rig_); }

 private:
  [[nodiscard]] std::map<PlainName, std::size_t> FirstByName(const PlainNames& names) const {
    std::map<PlainName, std::size_t> first;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] && joints_[i].position.allFinite()) first.emplace(*names[i], i);
    }
    return first;
  }

  std::optional<std::size_t> Take(const std::map<PlainName, std::size_t>& first,
                                  std::span<const std::string_view> words, JointSide side) {
    for (const std::string_view word : words) {
      const auto found = first.find({std::string(word), side});
      if (found == first.end() || is_taken_[found->second]) continue;
      is_taken_[found->second] = 1;
      return found->second;
    }
    return std::nullopt;
  }

  const std::vector<formats::NamedJoint>& joints_;
  std::vector<char> is_taken_;
  Rig rig_;
};

}  // namespace

Rig ReadRig(const std::vector<formats::NamedJoint>& joints) {
  SkeletonReader reader(joints);
  reader.Read(HumanBonesOf(joints));
  reader.Read(PlainNamesOf(joints));
  return reader.TakeRig();
}

}  // namespace capfit::body
