#include "client/arguments.h"

#include <algorithm>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/did_you_mean.h"

namespace capfit::client {
namespace {

constexpr char kEndOfFlags[] = "--";

bool IsFlag(const std::string& argument) { return argument.size() > 1 && argument[0] == '-'; }

// "--parts=torso" is the flag "--parts".
std::string FlagOf(const std::string& argument) { return argument.substr(0, argument.find('=')); }

bool IsList(const CLI::Option& option) { return option.get_delimiter() == ','; }

// Whether all checks of the option take the value; false where it has none.
bool Takes(CLI::Option& option, const std::string& value) {
  for (int i = 0;; ++i) {
    try {
      std::string text = value;
      if (!(*option.get_validator(i))(text).empty()) return false;
    } catch (const CLI::OptionNotFound&) {
      return i > 0;
    }
  }
}

bool TakesAll(CLI::Option& option, const std::string& argument) {
  if (argument.empty() || IsFlag(argument)) return false;
  for (const auto& piece : absl::StrSplit(argument, ',')) {
    const std::string word(piece);
    if (!word.empty() && !Takes(option, word)) return false;
  }
  return true;
}

const CLI::Option* FindOption(const CLI::App& command, const std::string& flag) {
  return command.get_option_no_throw(flag);
}

std::vector<std::string> FlagsOf(const CLI::App& command) {
  std::vector<std::string> flags;
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  }
  return flags;
}

std::vector<std::string> CommandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands({}))
    names.push_back(command->get_name());
  return names;
}

}  // namespace

const CLI::App* CommandOf(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (IsFlag(argument)) continue;
    for (const CLI::App* const command : app.get_subcommands({})) {
      if (command->get_name() == argument) return command;
    }
    break;
  }
  return nullptr;
}

std::vector<std::string> JoinLists(const CLI::App& app, std::vector<std::string> arguments) {
  const CLI::App* const command = CommandOf(app, arguments);
  if (command == nullptr) return arguments;
  std::vector<std::string> joined;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    joined.push_back(arguments[i]);
    if (arguments[i] == kEndOfFlags) {
      joined.insert(joined.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                    arguments.end());
      break;
    }
    // CLI11 has no look at an option's checks that is const.
    auto* const option = const_cast<CLI::Option*>(FindOption(*command, FlagOf(arguments[i])));
    if (option == nullptr || !IsFlag(arguments[i]) || !IsList(*option)) continue;
    if (FlagOf(arguments[i]) == arguments[i] && i + 1 < arguments.size()) {
      joined.push_back(arguments[++i]);
    }
    while (i + 1 < arguments.size() && TakesAll(*option, arguments[i + 1])) {
      absl::StrAppend(&joined.back(), ",", arguments[++i]);
    }
  }
  return joined;
}

std::string UnknownName(const CLI::App& app, const std::vector<std::string>& arguments) {
  const auto first = std::find_if_not(arguments.begin(), arguments.end(), IsFlag);
  const CLI::App* const command = CommandOf(app, arguments);
  if (first != arguments.end() && command == nullptr) {
    return absl::StrCat("'", *first, "' is no command", DidYouMean(*first, CommandsOf(app)));
  }
  const CLI::App& scope = command == nullptr ? app : *command;
  for (auto argument = arguments.begin(); argument != arguments.end(); ++argument) {
    if (*argument == kEndOfFlags) break;
    const std::string flag = FlagOf(*argument);
    if (flag.rfind("--", 0) != 0 || FindOption(argument < first ? app : scope, flag) != nullptr) {
      continue;
    }
    const std::string whose = command == nullptr ? "capfit" : command->get_name();
    return absl::StrCat(whose, " has no flag ", flag, DidYouMean(flag, FlagsOf(scope)));
  }
  return "";
}

std::string Complaint(const CLI::App& app, const std::vector<std::string>& arguments,
                      const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string prefix = "Could not convert: ";
  const std::size_t equals = text.find(" = ");
  if (text.rfind(prefix, 0) != 0 || equals == std::string::npos) return text;
  const std::string flag = text.substr(prefix.size(), equals - prefix.size());
  const CLI::App* const command = CommandOf(app, arguments);
  const CLI::Option* const option = FindOption(command == nullptr ? app : *command, flag);
  const bool is_whole =
      option != nullptr && absl::StrContains(option->get_type_name(), "INT");  // or UINT
  return absl::StrCat(flag, ": '", text.substr(equals + 3),
                      is_whole ? "' is no whole number, or too large a one" : "' is no number");
}

}  // namespace capfit::client
