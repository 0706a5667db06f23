#include "core/character/callers_word.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"

namespace capfit::character {
namespace {

// In a message.
constexpr std::size_t kMostNames = 32;

bool IsNamed(const std::vector<std::string>& patterns, const formats::SoupPart& part) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
    return MatchesName(pattern, part.name) ||
           (!part.material.empty() && MatchesName(pattern, part.material));
  });
}

std::string NamesOf(const std::vector<formats::SoupPart>& parts) {
  std::set<std::string> names;
  for (const formats::SoupPart& part : parts) {
    if (!part.name.empty()) names.insert(formats::Printable(part.name, kLongestNameTold));
  }
  if (names.empty()) return "without names";
  std::vector<std::string> told(names.begin(), names.end());
  const std::size_t more = told.size() > kMostNames ? told.size() - kMostNames : 0;
  told.resize(told.size() - more);
  return absl::StrCat(absl::StrJoin(told, ", "),
                      more > 0 ? absl::StrCat(" and ", more, " more") : "");
}

absl::Status CheckList(const std::vector<std::string>& patterns, const char* field,
                       const std::vector<formats::SoupPart>& parts) {
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    const auto is_it = [&](const formats::SoupPart& part) { return IsNamed({patterns[i]}, part); };
    if (std::any_of(parts.begin(), parts.end(), is_it)) continue;
    const std::string names = NamesOf(parts);
    return InvalidField(ErrorReason::kUnknownValue, absl::StrCat(field, "[", i, "]"),
                        absl::StrCat("is \"", formats::Printable(patterns[i], kLongestNameTold),
                                     "\", which no part is called; the parts are ", names),
                        {{"value", patterns[i]}, {"limit", names}});
  }
  return absl::OkStatus();
}

}  // namespace

// The last * takes one character more whenever what follows it does not fit: nothing before it has
// to be tried again.
bool MatchesName(std::string_view pattern, std::string_view name) {
  constexpr std::size_t kNone = std::string_view::npos;
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t star = kNone;
  std::size_t after_star = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      after_star = n;
    } else if (p < pattern.size() &&
               (pattern[p] == '?' ||
                absl::ascii_tolower(static_cast<unsigned char>(pattern[p])) ==
                    absl::ascii_tolower(static_cast<unsigned char>(name[n])))) {
      ++p;
      ++n;
    } else if (star != kNone) {
      p = star + 1;
      n = ++after_star;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

absl::Status CheckNames(const CharacterOptions& options,
                        const std::vector<formats::SoupPart>& parts) {
  CAPFIT_RETURN_IF_ERROR(CheckList(options.include, "options.include_parts", parts));
  return CheckList(options.exclude, "options.exclude_parts", parts);
}

void HearTheCaller(const CharacterOptions& options, const std::vector<formats::SoupPart>& parts,
                   const Shells& shells, std::vector<Verdict>& verdicts) {
  if (options.include.empty() && options.exclude.empty()) return;
  std::vector<char> is_included(parts.size(), 0);
  std::vector<char> is_excluded(parts.size(), 0);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    is_included[part] = IsNamed(options.include, parts[part]) ? 1 : 0;
    is_excluded[part] = IsNamed(options.exclude, parts[part]) ? 1 : 0;
  }
  for (std::size_t s = 0; s < verdicts.size(); ++s) {
    const std::size_t part = shells.shells[s].part;
    if (is_excluded[part] != 0) {
      verdicts[s] = {verdicts[s].kind, false, "excluded by the caller"};
    } else if (is_included[part] != 0) {
      verdicts[s] = {verdicts[s].kind, true, "included by the caller"};
    }
  }
}

}  // namespace capfit::character
