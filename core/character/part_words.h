// What the names of meshes and materials say about a part of an avatar.
#ifndef CAPFIT_CORE_CHARACTER_PART_WORDS_H_
#define CAPFIT_CORE_CHARACTER_PART_WORDS_H_

#include <optional>
#include <string_view>

namespace capfit::character {

// What a part of a file is to the character.
enum class PartKind {
  kBody,      // skin, or the surface that stands for it
  kClothing,  // worn close to the skin, armour included
  kShoe,
  kSkirt,  // and dresses: hangs between the legs
  kHair,
  kInner,      // eyes, lashes, teeth, tongue: in the body, or so small that it does not matter
  kAccessory,  // carried or put on: hat, glasses, bag, weapon
  kFragment    // floor, stand, stray pieces
};

// "body", "clothing", "shoe", "skirt", "hair", "inner", "accessory", "fragment".
[[nodiscard]] std::string_view PartKindName(PartKind kind);

// By the words in a name ("Wolf_Outfit_Top", "EyeLeft", "Hair_01"), in any case and with any
// separators; nothing where no word is known. The last known word decides: a "HairBand" is a band.
[[nodiscard]] std::optional<PartKind> KindFromName(std::string_view name);

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_PART_WORDS_H_
