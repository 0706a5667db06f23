// What a shell was taken for.
#ifndef CAPFIT_CORE_CHARACTER_VERDICT_H_
#define CAPFIT_CORE_CHARACTER_VERDICT_H_

#include <cstddef>
#include <string_view>

#include "core/character/part_words.h"

namespace capfit::character {

// Bytes of a part's name in a message.
inline constexpr std::size_t kLongestNameTold = 60;

struct Verdict {
  PartKind kind = PartKind::kBody;
  bool is_included = true;
  std::string_view reason;  // of static storage
};

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_VERDICT_H_
