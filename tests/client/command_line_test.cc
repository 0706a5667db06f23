// The command line in this process: what it says of arguments that are wrong, and of its flags.
#include "client/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "client/exit_code.h"
#include "core/base/status.h"
#include "tests/support/scratch.h"

namespace capfit::client {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Said {
  int exit_code = 0;
  std::string out;
  std::string err;
};

Said RunWords(const std::string& words) {
  std::istringstream stream(words);
  std::vector<std::string> arguments;
  for (std::string word; stream >> word;) arguments.push_back(word);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int exit_code = RunCommandLine(arguments);
  return {exit_code, testing::internal::GetCapturedStdout(),
          testing::internal::GetCapturedStderr()};
}

struct Case {
  std::string words;
  std::string problem;
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.words; }
};

class WrongUsage : public testing::TestWithParam<Case> {};

TEST_P(WrongUsage, IsSaidInTheWordsOfTheHelpAndEndsWith1) {
  const Said said = RunWords(GetParam().words);
  EXPECT_EQ(said.exit_code, kExitUsage);
  EXPECT_EQ(said.out, "");
  EXPECT_THAT(said.err, HasSubstr(GetParam().problem));
  EXPECT_THAT(said.err, HasSubstr("--help' for help"));
  EXPECT_THAT(said.err, Not(HasSubstr("FAILED")));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, WrongUsage,
    testing::Values(
        Case{"aproximate b.obj", "'aproximate' is no command; did you mean approximate?"},
        Case{"dance", "'dance' is no command\n"},
        Case{"approximate b.obj -o r.json --max-primitive 64",
             "approximate has no flag --max-primitive; did you mean --max-primitives?"},
        Case{"approximate b.obj -o r.json --lcoal=1", "did you mean --local?"},
        Case{"--versoin", "capfit has no flag --versoin; did you mean --version?"},
        Case{"approximate b.obj -o r.json --quality fast",
             "--quality: 'fast' is none of paper, balanced, tight"},
        Case{"approximate b.obj -o r.json --quality 1",
             "--quality: '1' is none of paper, balanced, tight"},
        Case{"approximate b.obj -o r.json --fit loose",
             "--fit: 'loose' is none of enclose, best\n"},
        Case{"approximate b.obj -o r.json --sex none",
             "--sex: 'none' is none of auto, female, male"},
        Case{"approximate b.obj -o r.json --unit furlong",
             "--unit: 'furlong' is none of auto, m, cm, mm, in\n"},
        Case{"approximate b.obj -o r.json --parts torso,wings",
             "--parts: 'wings' is none of all, torso, arms, legs, head, hands, feet"},
        Case{"approximate b.obj -o r.json --max-primitives many",
             "--max-primitives: 'many' is no whole number, or too large a one"},
        Case{"approximate b.obj -o r.json --tolerance-mm 101",
             "--tolerance-mm: '101' must be a number in [0, 100]"},
        Case{"approximate b.obj -o r.json --tolerance-mm nan",
             "--tolerance-mm: 'nan' must be a number in [0, 100]"},
        Case{"approximate b.obj -o r.json --seed -1",
             "--seed: '-1' must be a whole number in [0, 18446744073709551615]"},
        Case{"approximate b.obj -o r.json --seed 18446744073709551616", "must be a whole number"},
        Case{"load --duration nan", "--duration: 'nan' must be a number in [0.1, 86400]"},
        Case{"approximate b.obj -o r.json --server h:65536",
             "--server: 'h:65536' has port 65536, must be a whole number in [1, 65535]"},
        Case{"approximate b.obj -o r.json --server h:http",
             "has port http, must be a whole number"},
        Case{"info --server h:0", "must be a whole number in [1, 65535]"},
        Case{"approximate b.obj", "--output is required"},
        Case{"approximate -o r.json", "BODY is required"},
        Case{"mannequin -o b.obj --pose dancing", "--pose: 'dancing' is none of t, a, sides"},
        Case{"completion fish", "SHELL: 'fish' is none of bash"}));

TEST(CommandLine, OptionsInDegreesAndMetresAreNamedByTheirFlags) {
  Said said = RunWords("mannequin -o - --arm-angle-deg 170");
  EXPECT_EQ(said.exit_code, kExitRefused);
  EXPECT_THAT(said.err, HasSubstr("--arm-angle-deg is 170, must be in [8.6, 114.5]"));
  said = RunWords("mannequin -o - --height-m 3");
  EXPECT_THAT(said.err, HasSubstr("INVALID_ARGUMENT: --height-m is 3, must be in [0.8, 2.3]"));
  for (const char* const angle : {"8.6", "114.5"}) {
    EXPECT_EQ(
        RunWords(std::string("mannequin -o - --faces 2000 --arm-angle-deg ") + angle).exit_code, 0)
        << angle;
  }
}

// gRPC would end the process.
TEST(CommandLine, ATokenThatNoHeaderMayHoldIsRefused) {
  const test_support::Scratch scratch;
  const std::string file = scratch.Path("token");
  for (const auto& [token, problem] :
       {std::pair("abc\xc3\xa9\n", "byte 3 of the token is 195, must be a printed ASCII character"),
        std::pair("\xef\xbb\xbf"
                  "abc",
                  "byte 0 of the token is 239"),
        std::pair("a b\r\n", "byte 1 of the token is 32"),
        std::pair("\n", "its first line must be a token")}) {
    std::ofstream(file, std::ios::binary) << token;
    const Said said = RunWords("info --server 127.0.0.1:1 --token-file " + file);
    EXPECT_NE(said.exit_code, 0);
    EXPECT_THAT(said.err, HasSubstr(file + ": " + problem));
  }
}

TEST(CommandLine, HelpShowsTypesWhole) {
  EXPECT_THAT(RunWords("info --help").out, HasSubstr("--server HOST[:PORT]=127.0.0.1:50051"));
}

TEST(CommandLine, HelpIsInGroups) {
  const Said help = RunWords("approximate --help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* const group : {"Input:", "Output:", "What to fit:", "Budget (", "Server:"}) {
    EXPECT_THAT(help.out, HasSubstr(std::string("\n") + group)) << group;
  }
  EXPECT_THAT(help.out, HasSubstr("paper|balanced|tight"));
}

TEST(CommandLine, HelpAllHasEveryCommandAndFlag) {
  const Said all = RunWords("--help-all");
  EXPECT_EQ(all.exit_code, 0);
  for (const char* const word :
       {"approximate", "evaluate", "animate", "render", "mannequin", "info", "completion",
        "--max-primitives", "--arm-angle-deg", "--centers", "--json", "Exit codes: 0 done"}) {
    EXPECT_THAT(all.out, HasSubstr(word));
  }
}

TEST(CommandLine, WarningsThatTravelWithAnErrorAreShown) {
  const absl::Status status =
      WithWarnings(InvalidField(ErrorReason::kOutOfRange, "options.seed", "is odd"),
                   std::vector<Warning>{{"HOLES_CLOSED", "2 holes were closed", 2}});
  testing::internal::CaptureStderr();
  EXPECT_EQ(Report(status), kExitRefused);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "capfit: warning: 2 holes were closed (HOLES_CLOSED)\n"
            "capfit: INVALID_ARGUMENT: --seed is odd\n");
}

}  // namespace
}  // namespace capfit::client
