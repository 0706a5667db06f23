// Options that take words, and lists of them.
#ifndef CAPFIT_CLIENT_WORD_OPTION_H_
#define CAPFIT_CLIENT_WORD_OPTION_H_

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace capfit::client {

// Takes one of `words` in any case, '-' for '_', and passes it on as change(word) gives it. Refuses
// others by saying "'fast' is none of paper, tight", where `shown` are those that are named.
[[nodiscard]] CLI::Validator WordCheck(std::vector<std::string> words,
                                       std::vector<std::string> shown,
                                       std::function<std::string(const std::string&)> change);

// "paper|tight": how help shows a choice, and where shell completion finds it.
[[nodiscard]] std::string Choice(const std::vector<std::string>& words);

// An option of an enum; `words` as in option_words.h. The value at hand is the default that help
// shows.
template <typename Value>
CLI::Option* AddWordOption(CLI::App& command, const std::string& flag, Value& target,
                           const std::vector<std::pair<std::string, Value>>& words,
                           const std::string& help) {
  std::vector<std::string> all;
  std::vector<std::string> shown;
  std::vector<Value> seen;
  std::string preset;
  for (const auto& [word, value] : words) {
    all.push_back(word);
    if (std::find(seen.begin(), seen.end(), value) != seen.end()) continue;
    seen.push_back(value);
    shown.push_back(word);
    if (value == target) preset = word;
  }
  // CLI11 reads an enum from its number.
  const auto number = [words](const std::string& word) {
    for (const auto& [known, value] : words) {
      if (known == word) return std::to_string(static_cast<int>(value));
    }
    return word;
  };
  return command.add_option(flag, target, help)
      ->transform(WordCheck(all, shown, number))
      ->type_name(Choice(shown))
      ->default_str(preset);
}

// An option that takes one of `words`, which are kept as they are.
CLI::Option* AddWordOption(CLI::App& command, const std::string& flag, std::string& target,
                           const std::vector<std::string>& words, const std::string& help);

// A list of words, separated by commas or (see arguments.h) blanks.
CLI::Option* AddWordList(CLI::App& command, const std::string& flag,
                         std::vector<std::string>& target, const std::vector<std::string>& words,
                         const std::string& help);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_WORD_OPTION_H_
