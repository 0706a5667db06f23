// The names of parts that the caller includes or excludes.
#ifndef CAPFIT_CORE_CHARACTER_CALLERS_WORD_H_
#define CAPFIT_CORE_CHARACTER_CALLERS_WORD_H_

#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "core/character/find_character.h"
#include "core/character/shells.h"
#include "core/character/verdict.h"
#include "core/formats/polygon_soup.h"

namespace capfit::character {

// Whether the whole name is what the pattern says, without regard to case: * stands for any
// characters, ? for one. O(pattern * name) at most.
[[nodiscard]] bool MatchesName(std::string_view pattern, std::string_view name);

// INVALID_ARGUMENT for a pattern that no part and no material is called, listing the parts.
[[nodiscard]] absl::Status CheckNames(const CharacterOptions& options,
                                      const std::vector<formats::SoupPart>& parts);

// Overrules the verdicts of the shells whose parts are named; excluding wins.
void HearTheCaller(const CharacterOptions& options, const std::vector<formats::SoupPart>& parts,
                   const Shells& shells, std::vector<Verdict>& verdicts);

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_CALLERS_WORD_H_
