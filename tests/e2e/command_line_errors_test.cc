// What the command line says when something is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "absl/strings/str_split.h"
#include "tests/e2e/command_line.h"
#include "tests/server/certificates.h"

namespace capfit::e2e {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

constexpr char kCube[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

// gRPC would take such files without a word, and then no connection came about.
TEST_F(CommandLine, FilesOfTlsAreJudgedBeforeTheServerIsAsked) {
  const server::CertificateAndKey authority = server::MakeAuthority("Test authority");
  const server::CertificateAndKey own = server::MakeCertificate(authority);
  const server::CertificateAndKey past = server::MakeCertificate(authority, -7200, -3600);
  WriteText(Path("no.pem"), "-----BEGIN NOTHING-----\n");
  WriteText(Path("ca.pem"), authority.certificate);
  WriteText(Path("own.pem"), own.certificate);
  WriteText(Path("own.key"), own.key);
  WriteText(Path("past.pem"), past.certificate);
  WriteText(Path("past.key"), past.key);
  for (const auto& [flags, problem] : {
           std::pair("--tls-ca no.pem", "no.pem has no certificate in PEM"),
           std::pair("--tls-certificate own.pem", "--tls-key is missing"),
           std::pair("--tls-key own.key", "--tls-certificate is missing"),
           std::pair("--tls-certificate no.pem --tls-key own.key", "no.pem has no certificate"),
           std::pair("--tls-certificate own.pem --tls-key no.pem", "no.pem has no private key"),
           std::pair("--tls-certificate own.pem --tls-key past.key", "is not the key of the"),
           std::pair("--tls-certificate past.pem --tls-key past.key", "past.pem expired on"),
       }) {
    std::vector<std::string> words = {"info", "--server", "localhost:1"};
    const std::vector<std::string> parts = absl::StrSplit(flags, ' ');
    for (const std::string& word : parts) {
      words.push_back(word.starts_with("--") ? word : Path(word));
    }
    const Outcome outcome = RunCapfit(words);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_THAT(outcome.err, HasSubstr(problem)) << flags;
  }
}

TEST_F(CommandLine, LostStandardOutputIsAnError) {
  for (const auto& [program, words, exit_code] :
       {std::tuple(CAPFIT_CLIENT_PROGRAM, "completion bash", 1),
        std::tuple(CAPFIT_CLIENT_PROGRAM, "--help", 1),
        std::tuple(CAPFIT_SERVER_PROGRAM, "--print-config", 3)}) {
    const Outcome outcome =
        RunProgram("/bin/sh", {"-c", std::string(program) + " " + words + " >/dev/full"});
    EXPECT_EQ(outcome.exit_code, exit_code) << program << " " << words;
    EXPECT_THAT(outcome.err, HasSubstr("cannot write standard output"));
  }
}

TEST_F(CommandLine, ResultsGapsAndWeightsOfAnotherBodyAreRefused) {
  WriteText(Path("centimetres.obj"), InCentimetres(ReadText(Body())));
  ASSERT_EQ(RunCapfit({"mannequin", "-o", Path("other.obj"), "--faces", "6000"}).exit_code, 0);
  static_cast<void>(Approximate({"--local", "--heat-map", "--skinning", "dense"}));
  const std::string result = Path("result.json");
  const auto refused = [&](const std::vector<std::string>& words, const std::string& problem) {
    const Outcome outcome = RunCapfit(words);
    EXPECT_EQ(outcome.exit_code, 2) << words[0];
    EXPECT_THAT(outcome.err, HasSubstr(problem)) << words[0];
    EXPECT_EQ(outcome.out, "");
  };
  const std::string stranger = "RESULT is not of this BODY";
  refused({"evaluate", Path("centimetres.obj"), result}, stranger);
  refused({"evaluate", Path("centimetres.obj"), result}, "100 times as large");
  refused({"render", Path("centimetres.obj"), result, "-o", Path("p.png")}, stranger);
  WriteText(Path("frames.bin"), "");
  refused({"animate", Path("centimetres.obj"), result, "--frames", Path("frames.bin"), "-o",
           Path("c.json")},
          stranger);
  refused(
      {"animate", Path("other.obj"), result, "--frames", Path("frames.bin"), "-o", Path("c.json")},
      "WEIGHTS has ");
  refused({"render", Path("other.obj"), result, "--gaps", Path("result.gaps.json"), "-o",
           Path("p.png")},
          "--gaps has ");
  // Another tessellation of the same body is the same body.
  EXPECT_EQ(RunCapfit({"evaluate", Path("other.obj"), result}).exit_code, 0);
  // Another program's set has no more than its spheres to tell.
  WriteText(Path("foreign.json"), ordered_json{{"spheres", Read(result)["spheres"]},
                                               {"capsules", Read(result)["capsules"]}}
                                      .dump());
  EXPECT_EQ(RunCapfit({"evaluate", Body(), Path("foreign.json")}).exit_code, 0);
  refused({"evaluate", Path("centimetres.obj"), Path("foreign.json")}, stranger);
}

TEST_F(CommandLine, WarningsGoToStandardErrorAlsoWhenQuietAndWithErrors) {
  WriteText(Path("twice.obj"), ReadText(Body()) + "f 1 2 3\nf 1 2 3\n");
  WriteText(Path("cube.obj"), std::string(kCube) + "f 4 3 2 1\n");
  for (const auto& place :
       std::vector<std::vector<std::string>>{{"--local"}, {"--server", server_->address()}}) {
    std::vector<std::string> words = {"approximate", Path("twice.obj"), "-o", Path("w.json"),
                                      "--quiet"};
    words.insert(words.end(), place.begin(), place.end());
    const Outcome quiet = RunCapfit(words);
    EXPECT_EQ(quiet.exit_code, 0) << quiet.err;
    EXPECT_EQ(quiet.out, "");
    EXPECT_THAT(quiet.err, HasSubstr("capfit: warning: "));
    words[1] = Path("cube.obj");
    const Outcome failed = RunCapfit(words);
    EXPECT_EQ(failed.exit_code, 2);
    EXPECT_THAT(failed.err, HasSubstr("(DUPLICATE_FACES)\ncapfit: FAILED_PRECONDITION: "));
  }
}

TEST_F(CommandLine, OutputsAreCheckedFirstAndLeftAloneWhenTheFitFails) {
  const Outcome early = RunCapfit({"approximate", Body(), "-o", Path("no/folder/r.json"),
                                   "--server", "127.0.0.1:1", "--timeout", "60"});
  EXPECT_EQ(early.exit_code, 1) << "not 3: the server was not asked";
  EXPECT_THAT(early.err, HasSubstr("cannot write " + Path("no/folder/r.json")));
  WriteText(Path("cube.obj"), kCube);
  WriteText(Path("old.json"), "kept");
  for (const char* const name : {"old.json", "new.json"}) {
    EXPECT_EQ(RunCapfit({"approximate", Path("cube.obj"), "-o", Path(name), "--local", "--heat-map",
                         "--skinning", "dense"})
                  .exit_code,
              2);
  }
  EXPECT_EQ(ReadText(Path("old.json")), "kept");
  for (const char* const name : {"new.json", "new.gaps.json", "new.weights.f32"}) {
    EXPECT_FALSE(std::filesystem::exists(Path(name))) << name;
  }
  std::filesystem::create_directories(Path("taken.gaps.f32"));
  const Outcome beside =
      RunCapfit({"approximate", Body(), "-o", Path("taken.json"), "--local", "--heat-map"});
  EXPECT_EQ(beside.exit_code, 1);
  EXPECT_THAT(beside.err, HasSubstr("cannot write " + Path("taken.gaps.f32")));
  EXPECT_FALSE(std::filesystem::exists(Path("taken.json")));
}

TEST_F(CommandLine, AddressesAreMadeWholeAndBadPortsRefusedByBothSides) {
  const Outcome nobody = RunCapfit({"info", "--server", "127.0.0.1:1"});
  EXPECT_EQ(nobody.exit_code, 3);
  EXPECT_THAT(nobody.err, HasSubstr("cannot reach a server at 127.0.0.1:1 ("));
  EXPECT_THAT(nobody.err, HasSubstr("capfit-server --listen 127.0.0.1:1"));
  const Outcome fit =
      RunCapfit({"approximate", Body(), "-o", Path("r.json"), "--server", "127.0.0.1:1"});
  EXPECT_EQ(fit.exit_code, 3);
  EXPECT_THAT(fit.err, HasSubstr("--local fits without one"));
  for (const char* const address : {"127.0.0.1:65536", "127.0.0.1:http"}) {
    const Outcome client = RunCapfit({"info", "--server", address});
    EXPECT_EQ(client.exit_code, 1);
    EXPECT_THAT(client.err, HasSubstr("must be a whole number in [1, 65535]"));
    const Outcome server = RunProgram(CAPFIT_SERVER_PROGRAM, {"--listen", address});
    EXPECT_EQ(server.exit_code, 1);
    EXPECT_THAT(server.err + server.out, HasSubstr("must be a whole number in [0, 65535]"));
  }
}

TEST_F(CommandLine, OptionsThatMakeNoSenseAreRefusedNotIgnored) {
  for (const auto& option :
       std::vector<std::vector<std::string>>{{"--engine", "quake"},
                                             {"--fit", "best", "--tolerance-mm", "1"},
                                             {"--max-primitives", "3"},
                                             {"--max-spheres", "9"},
                                             {"--polygon-error", "3"}}) {
    for (const auto& place :
         std::vector<std::vector<std::string>>{{"--local"}, {"--server", server_->address()}}) {
      std::vector<std::string> arguments = {"approximate", Body(), "-o", Path("refused.json")};
      arguments.insert(arguments.end(), option.begin(), option.end());
      arguments.insert(arguments.end(), place.begin(), place.end());
      const Outcome outcome = RunCapfit(arguments);
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_THAT(outcome.err,
                  HasSubstr("INVALID_ARGUMENT: " + option[option.size() - 2] + " is "));
      EXPECT_EQ(ReadText(Path("refused.json")), "");
    }
  }
}

TEST_F(CommandLine, WrongFilesEndWithCodeAndMessageInBothPlaces) {
  WriteText(Path("cube.obj"), kCube);
  WriteText(Path("nan.obj"), "v 0 0 0\nv nan 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n");
  WriteText(Path("range.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  WriteText(Path("prose.obj"), "It was a dark and stormy night.\n");
  WriteText(Path("empty.obj"), "");
  ASSERT_EQ(RunCapfit({"mannequin", "-o", Path("whole.ply"), "--faces", "4000"}).exit_code, 0);
  const std::string ply = ReadText(Path("whole.ply"));
  WriteText(Path("truncated.ply"), ply.substr(0, ply.size() / 2));
  struct Case {
    std::string file;
    std::string code;
    std::string problem;
  };
  for (const Case& c :
       {Case{"cube.obj", "FAILED_PRECONDITION", "body"},
        Case{"nan.obj", "INVALID_ARGUMENT", "finite"}, Case{"range.obj", "INVALID_ARGUMENT", "9"},
        Case{"prose.obj", "INVALID_ARGUMENT", "file"},
        Case{"empty.obj", "INVALID_ARGUMENT", "empty"},
        Case{"truncated.ply", "INVALID_ARGUMENT", "ends early"}}) {
    for (const auto& place :
         std::vector<std::vector<std::string>>{{"--local"}, {"--server", server_->address()}}) {
      std::vector<std::string> arguments = {"approximate", Path(c.file), "-o", Path("no.json")};
      arguments.insert(arguments.end(), place.begin(), place.end());
      const Outcome outcome = RunCapfit(arguments);
      EXPECT_EQ(outcome.exit_code, 2) << c.file << ": " << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(c.code)) << c.file;
      EXPECT_THAT(outcome.err, HasSubstr(c.problem)) << c.file;
    }
  }
}

TEST_F(CommandLine, UsageFilesAndServersHaveTheirExitCodes) {
  EXPECT_EQ(RunCapfit({}).exit_code, 1);
  EXPECT_EQ(RunCapfit({"--help"}).exit_code, 0);
  EXPECT_EQ(RunCapfit({"approximate", Body()}).exit_code, 1) << "-o is missing";
  EXPECT_EQ(RunCapfit({"approximate", Path("none.obj"), "-o", Path("r.json"), "--local"}).exit_code,
            1);
  EXPECT_EQ(RunCapfit({"approximate", Body(), "-o", Path("no/folder/r.json"), "--local"}).exit_code,
            1);
  EXPECT_EQ(RunCapfit({"info", "--server", "127.0.0.1:1"}).exit_code, 3);
  EXPECT_EQ(RunCapfit({"info", "--server", server_->address()}).exit_code, 0);
  // A seed of its own: what the server has kept may be there in time.
  EXPECT_EQ(RunCapfit({"approximate", Body(), "-o", Path("r.json"), "--server", server_->address(),
                       "--seed", "1702", "--quality", "tight", "--timeout", "0.002"})
                .exit_code,
            3);
}

TEST_F(CommandLine, ASetWithoutSpheresIsNotPerfect) {
  WriteText(Path("empty.json"), R"({"spheres": [], "capsules": []})");
  const Outcome outcome = RunCapfit({"evaluate", Body(), Path("empty.json")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("empty.json has no spheres"));
}

}  // namespace
}  // namespace capfit::e2e
