// The verdicts of shells as the fate of parts and faces.
#ifndef CAPFIT_CORE_CHARACTER_CHARACTER_REPORT_H_
#define CAPFIT_CORE_CHARACTER_CHARACTER_REPORT_H_

#include <vector>

#include "absl/status/statusor.h"
#include "core/character/find_character.h"
#include "core/character/shells.h"
#include "core/character/verdict.h"
#include "core/formats/polygon_soup.h"

namespace capfit::character {

// `verdicts`: one for each shell. FAILED_PRECONDITION (NOTHING_TO_FIT) where none is included.
[[nodiscard]] absl::StatusOr<Character> MakeCharacter(const Shells& shells,
                                                      const std::vector<formats::SoupPart>& parts,
                                                      const std::vector<Verdict>& verdicts,
                                                      bool has_joints);

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_CHARACTER_REPORT_H_
