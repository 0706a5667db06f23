#include "core/character/part_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "core/base/enum_index.h"

namespace capfit::character {
namespace {

struct KnownWord {
  std::string_view word;
  PartKind kind;
};

// Whole words, in the plural too; with * also as the beginning of longer ones: "eye*" is in
// "eyelash", but "hat" not in "hatch".
constexpr auto kKnownWords = std::to_array<KnownWord>({
    {"hair*", PartKind::kHair},          {"beard", PartKind::kHair},
    {"mustache", PartKind::kHair},       {"moustache", PartKind::kHair},
    {"ponytail*", PartKind::kHair},      {"braid", PartKind::kHair},
    {"bangs", PartKind::kHair},          {"scalp", PartKind::kHair},
    {"eye*", PartKind::kInner},          {"iris*", PartKind::kInner},
    {"cornea", PartKind::kInner},        {"sclera", PartKind::kInner},
    {"pupil", PartKind::kInner},         {"lash*", PartKind::kInner},
    {"eyebrow", PartKind::kInner},       {"teeth*", PartKind::kInner},
    {"tooth", PartKind::kInner},         {"tongue*", PartKind::kInner},
    {"gum", PartKind::kInner},           {"mouth*", PartKind::kInner},
    {"tearline", PartKind::kInner},      {"skirt*", PartKind::kSkirt},
    {"dress", PartKind::kSkirt},         {"gown", PartKind::kSkirt},
    {"kilt", PartKind::kSkirt},          {"shoe*", PartKind::kShoe},
    {"boot*", PartKind::kShoe},          {"sandal*", PartKind::kShoe},
    {"sneaker*", PartKind::kShoe},       {"footwear*", PartKind::kShoe},
    {"heels", PartKind::kShoe},          {"top", PartKind::kClothing},
    {"bottom", PartKind::kClothing},     {"shirt*", PartKind::kClothing},
    {"tshirt", PartKind::kClothing},     {"pants", PartKind::kClothing},
    {"trouser*", PartKind::kClothing},   {"jeans", PartKind::kClothing},
    {"shorts", PartKind::kClothing},     {"jacket*", PartKind::kClothing},
    {"coat", PartKind::kClothing},       {"suit", PartKind::kClothing},
    {"outfit*", PartKind::kClothing},    {"cloth", PartKind::kClothing},
    {"sock", PartKind::kClothing},       {"glove", PartKind::kClothing},
    {"belt", PartKind::kClothing},       {"plate", PartKind::kClothing},
    {"armor", PartKind::kClothing},      {"armour", PartKind::kClothing},
    {"vest", PartKind::kClothing},       {"sweater", PartKind::kClothing},
    {"hoodie", PartKind::kClothing},     {"underwear", PartKind::kClothing},
    {"glasses*", PartKind::kAccessory},  {"spectacles", PartKind::kAccessory},
    {"hat", PartKind::kAccessory},       {"cap", PartKind::kAccessory},
    {"helmet*", PartKind::kAccessory},   {"crown", PartKind::kAccessory},
    {"bag", PartKind::kAccessory},       {"handbag", PartKind::kAccessory},
    {"backpack*", PartKind::kAccessory}, {"rucksack*", PartKind::kAccessory},
    {"purse", PartKind::kAccessory},     {"sword*", PartKind::kAccessory},
    {"weapon*", PartKind::kAccessory},   {"gun", PartKind::kAccessory},
    {"rifle", PartKind::kAccessory},     {"shield", PartKind::kAccessory},
    {"bow", PartKind::kAccessory},       {"staff", PartKind::kAccessory},
    {"knife", PartKind::kAccessory},     {"buckle*", PartKind::kAccessory},
    {"earring*", PartKind::kAccessory},  {"necklace*", PartKind::kAccessory},
    {"watch", PartKind::kAccessory},     {"jewel", PartKind::kAccessory},
    {"wing", PartKind::kAccessory},      {"horn", PartKind::kAccessory},
    {"umbrella", PartKind::kAccessory},  {"floor", PartKind::kFragment},
    {"ground", PartKind::kFragment},     {"turntable", PartKind::kFragment},
    {"pedestal", PartKind::kFragment},   {"skin", PartKind::kBody},
    {"body", PartKind::kBody},           {"head", PartKind::kBody},
    {"face", PartKind::kBody},           {"hand", PartKind::kBody},
    {"foot", PartKind::kBody},           {"feet", PartKind::kBody},
    {"torso", PartKind::kBody},
});
bool IsWord(std::string_view token, std::string_view word) {
  const bool may_go_on = word.back() == '*';
  if (may_go_on) word.remove_suffix(1);
  if (token.substr(0, word.size()) != word) return false;
  const std::string_view rest = token.substr(word.size());
  return may_go_on || rest.empty() || rest == "s" || rest == "es";
}

// Words in small letters; a capital after a small letter begins one, and so does a digit.
std::vector<std::string> WordsOf(std::string_view name) {
  std::vector<std::string> words;
  bool begins = true;
  char before = ' ';
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalpha(u) == 0) {
      begins = true;
    } else {
      const bool is_hump =
          std::isupper(u) != 0 && std::islower(static_cast<unsigned char>(before)) != 0;
      if (begins || is_hump) words.emplace_back();
      words.back() += static_cast<char>(std::tolower(u));
      begins = false;
    }
    before = c;
  }
  return words;
}

// Words of one kind of thing that another stands on: "Outfit_Footwear" is footwear, and a
// "FaceEyelash" no face.
bool IsGeneral(PartKind kind) { return kind == PartKind::kBody || kind == PartKind::kClothing; }

}  // namespace

std::string_view PartKindName(PartKind kind) {
  static constexpr std::array<std::string_view, 8> kNames = {
      "body", "clothing", "shoe", "skirt", "hair", "inner", "accessory", "fragment"};
  return kNames[Index(kind)];
}

std::optional<PartKind> KindFromName(std::string_view name) {
  std::optional<PartKind> found;
  for (const std::string& token : WordsOf(name)) {
    const auto known =
        std::find_if(kKnownWords.begin(), kKnownWords.end(),
                     [&](const KnownWord& entry) { return IsWord(token, entry.word); });
    if (known == kKnownWords.end()) continue;
    if (found && !IsGeneral(*found) && IsGeneral(known->kind)) continue;
    found = known->kind;
  }
  return found;
}

}  // namespace capfit::character
