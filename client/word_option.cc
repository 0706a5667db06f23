#include "client/word_option.h"

#include <algorithm>
#include <cctype>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace capfit::client {
namespace {

std::string Plain(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char letter) {
    return letter == '-' ? '_' : static_cast<char>(std::tolower(letter));
  });
  return word;
}

}  // namespace

CLI::Validator WordCheck(std::vector<std::string> words, std::vector<std::string> shown,
                         std::function<std::string(const std::string&)> change) {
  CLI::Validator check;
  check.description("").operation([words = std::move(words), shown = std::move(shown),
                                   change = std::move(change)](std::string& text) -> std::string {
    for (const std::string& word : words) {
      if (Plain(word) != Plain(text)) continue;
      text = change(word);
      return "";
    }
    return absl::StrCat("'", text, "' is none of ", absl::StrJoin(shown, ", "));
  });
  return check;
}

std::string Choice(const std::vector<std::string>& words) { return absl::StrJoin(words, "|"); }

CLI::Option* AddWordOption(CLI::App& command, const std::string& flag, std::string& target,
                           const std::vector<std::string>& words, const std::string& help) {
  return command.add_option(flag, target, help)
      ->transform(WordCheck(words, words, [](const std::string& word) { return word; }))
      ->type_name(Choice(words))
      ->capture_default_str();
}

CLI::Option* AddWordList(CLI::App& command, const std::string& flag,
                         std::vector<std::string>& target, const std::vector<std::string>& words,
                         const std::string& help) {
  return command.add_option(flag, target, help)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->transform(WordCheck(words, words, [](const std::string& word) { return word; }))
      ->type_name(Choice(words));
}

}  // namespace capfit::client
