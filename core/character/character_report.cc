#include "core/character/character_report.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"

namespace capfit::character {
namespace {

// In a message.
constexpr std::size_t kEntriesTold = 8;

// One entry for all shells of a part that had the same fate, in the order of the parts.
std::vector<CharacterPart> FatesOf(const Shells& shells,
                                   const std::vector<formats::SoupPart>& parts,
                                   const std::vector<Verdict>& verdicts) {
  using Fate = std::tuple<std::size_t, PartKind, bool, std::string_view>;
  double area = 0.0;
  for (const Shell& shell : shells.shells) area += shell.area;
  std::map<Fate, std::size_t> place;
  std::vector<std::vector<CharacterPart>> of_part(parts.size());
  for (std::size_t s = 0; s < verdicts.size(); ++s) {
    const Verdict& verdict = verdicts[s];
    const std::size_t part = shells.shells[s].part;
    std::vector<CharacterPart>& entries = of_part[part];
    const auto [at, is_new] = place.try_emplace(
        Fate{part, verdict.kind, verdict.is_included, verdict.reason}, entries.size());
    if (is_new) {
      entries.push_back({parts[part].name, parts[part].material, verdict.kind, verdict.is_included,
                         std::string(verdict.reason)});
    }
    CharacterPart& entry = entries[at->second];
    entry.shell_count += 1;
    entry.face_count += shells.shells[s].face_count;
    entry.area_share += area > 0.0 ? shells.shells[s].area / area : 0.0;
  }
  std::vector<CharacterPart> all;
  for (std::vector<CharacterPart>& entries : of_part) {
    for (CharacterPart& entry : entries) all.push_back(std::move(entry));
  }
  return all;
}

void WarnOfLeftOut(Character& character) {
  std::size_t shells = 0;
  std::size_t faces = 0;
  std::size_t entries = 0;
  std::vector<std::string> told;
  for (const CharacterPart& part : character.parts) {
    if (part.is_included) continue;
    shells += part.shell_count;
    faces += part.face_count;
    if (++entries > kEntriesTold) continue;
    told.push_back(absl::StrCat(formats::Printable(part.name, kLongestNameTold),
                                part.name.empty() ? "" : ": ", std::string(PartKindName(part.kind)),
                                ", ", part.reason));
  }
  if (shells == 0) return;
  if (entries > kEntriesTold) told.push_back(absl::StrCat(entries - kEntriesTold, " more"));
  character.warnings.push_back({"PARTS_LEFT_OUT",
                                absl::StrCat(shells, " separate parts (", faces,
                                             " faces) were left out: ", absl::StrJoin(told, "; ")),
                                static_cast<std::int64_t>(shells)});
}

}  // namespace

absl::StatusOr<Character> MakeCharacter(const Shells& shells,
                                        const std::vector<formats::SoupPart>& parts,
                                        const std::vector<Verdict>& verdicts, bool has_joints) {
  Character character;
  character.has_joints = has_joints;
  std::set<std::uint32_t> surfaces;
  for (std::size_t s = 0; s < verdicts.size(); ++s) {
    if (verdicts[s].is_included) surfaces.insert(shells.shells[s].surface);
  }
  character.surface_count = surfaces.size();
  if (surfaces.empty()) {
    return Refused(ErrorReason::kNothingToFit,
                   "no part of the file is taken for the character; include some by name");
  }
  character.parts = FatesOf(shells, parts, verdicts);
  character.is_left_out.resize(shells.shell_of_face.size());
  for (std::size_t face = 0; face < character.is_left_out.size(); ++face) {
    character.is_left_out[face] = verdicts[shells.shell_of_face[face]].is_included ? 0 : 1;
  }
  WarnOfLeftOut(character);
  return character;
}

}  // namespace capfit::character
