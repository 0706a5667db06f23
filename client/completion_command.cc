#include "client/completion_command.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/exit_code.h"
#include "client/help_format.h"
#include "client/word_option.h"

namespace capfit::client {
namespace {

std::string FlagsOf(const CLI::Option& option, const char* separator) {
  std::vector<std::string> flags;
  for (const std::string& name : option.get_lnames()) flags.push_back("--" + name);
  for (const std::string& name : option.get_snames()) flags.push_back("-" + name);
  return absl::StrJoin(flags, separator);
}

// "paper tight" of an option whose help shows "paper|tight"; "" for one that takes anything, which
// help shows in capital letters.
std::string WordsOf(const CLI::Option& option) {
  std::string words = ShownType(option);
  const auto is_capital = [](unsigned char letter) { return std::isupper(letter) != 0; };
  if (std::any_of(words.begin(), words.end(), is_capital)) return "";
  std::replace(words.begin(), words.end(), '|', ' ');
  return words;
}

// The case of one command: its flags, and the words that follow some of them.
std::string CommandCase(const CLI::App& command) {
  std::string flags;
  std::string after;
  std::string positionals;
  for (const CLI::Option* const option : command.get_options()) {
    const std::string words = WordsOf(*option);
    if (option->get_positional() && !words.empty()) absl::StrAppend(&positionals, " ", words);
    if (!option->nonpositional()) continue;
    absl::StrAppend(&flags, flags.empty() ? "" : " ", FlagsOf(*option, " "));
    if (words.empty()) continue;
    absl::StrAppend(&after, "        ", FlagsOf(*option, "|"), ") words=\"", words, "\" ;;\n");
  }
  return absl::StrCat("    ", command.get_name(), ")\n      flags=\"", flags, "\"\n      words=\"",
                      positionals, "\"\n      case \"$previous\" in\n", after,
                      "        *) ;;\n      esac ;;\n");
}

constexpr char kHead[] =
    R"(# bash completion of capfit; made by `capfit completion bash`. Either of
#   source <(capfit completion bash)
#   capfit completion bash >/etc/bash_completion.d/capfit
_capfit() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} flags="" words=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "$commands" -- "$current"))
    return
  fi
  case "${COMP_WORDS[1]}" in
)";
constexpr char kTail[] =
    R"(    *) ;;
  esac
  if [[ "$current" == -* ]]; then
    COMPREPLY=($(compgen -W "$flags" -- "$current"))
  elif [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}
complete -F _capfit capfit
)";

}  // namespace

std::string BashCompletion(const CLI::App& app) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* const command : app.get_subcommands({})) {
    names.push_back(command->get_name());
    cases += CommandCase(*command);
  }
  std::string head = kHead;
  const std::string place = "$commands";
  head.replace(head.find(place), place.size(), absl::StrJoin(names, " ") + " --help --version");
  return head + cases + kTail;
}

void AddCompletionCommand(CLI::App& app, int& exit_code) {
  CLI::App* const command =
      app.add_subcommand("completion", "Print a script that completes commands in a shell");
  const auto shell = std::make_shared<std::string>();
  AddWordOption(*command, "SHELL", *shell, {"bash"}, "The shell")->required();
  command->footer("bash: put  source <(capfit completion bash)  into ~/.bashrc.");
  command->callback([&app, shell, &exit_code] {
    std::fputs(BashCompletion(app).c_str(), stdout);
    exit_code = kExitDone;
  });
}

}  // namespace capfit::client
