// The command line as a user runs it, alone and against a server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/processes.h"

namespace capfit::e2e {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

// One mannequin and one server for all tests of this file.
class CommandLine : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new Scratch;
    server_ = new ServerProcess;
    const Outcome made = RunCapfit({"mannequin", "-o", Body(), "--faces", "8000"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() {
    delete server_;
    delete scratch_;
  }
  static std::string Path(const std::string& name) { return scratch_->Path(name); }
  static std::string Body() { return Path("body.obj"); }

  // `capfit approximate BODY ...`, with the result read.
  static ordered_json Approximate(const std::vector<std::string>& flags) {
    std::vector<std::string> arguments = {"approximate", Body(), "-o", Path("result.json")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Outcome outcome = RunCapfit(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    last_out_ = outcome.out;
    return ordered_json::parse(ReadText(Path("result.json")), nullptr, false);
  }

  // All that must not depend on where and with how many threads it was computed.
  static std::string Bits(const ordered_json& result) {
    std::string bits;
    for (const char* const member :
         {"spheres", "capsules", "sphere_parts", "landmarks", "warnings", "metrics", "polygons"}) {
      if (result.contains(member)) bits += result[member].dump() + "\n";
    }
    return bits;
  }

  static Scratch* scratch_;
  static ServerProcess* server_;
  static std::string last_out_;
};
Scratch* CommandLine::scratch_ = nullptr;
ServerProcess* CommandLine::server_ = nullptr;
std::string CommandLine::last_out_;

TEST_F(CommandLine, LocalAndServerGiveTheSameBits) {
  const std::vector<std::string> options = {"--parts", "all", "--polygons", "--skinning", "dense"};
  std::vector<std::string> local = options;
  local.push_back("--local");
  const std::string bits = Bits(Approximate(local));
  const std::string weights = ReadText(Path("result.weights.f32"));
  EXPECT_GT(weights.size(), 500'000U);
  std::vector<std::string> remote = options;
  remote.insert(remote.end(), {"--server", server_->address()});
  EXPECT_EQ(Bits(Approximate(remote)), bits);
  EXPECT_EQ(ReadText(Path("result.weights.f32")), weights);
}

TEST_F(CommandLine, AnyNumberOfThreadsGivesTheSameBits) {
  const std::string bits = Bits(Approximate({"--local", "--threads", "1"}));
  EXPECT_GT(bits.size(), 100U);
  for (const char* const threads : {"2", "7"}) {
    EXPECT_EQ(Bits(Approximate({"--local", "--threads", threads})), bits) << threads;
  }
}

TEST_F(CommandLine, TheTableShowsPartsMetricsAndStages) {
  const ordered_json result = Approximate({"--server", server_->address()});
  EXPECT_FALSE(result["spheres"].empty());
  EXPECT_LE(result["metrics"]["n_p"].get<int>(), 64);
  EXPECT_EQ(result["spheres"].size() + result["capsules"].size(),
            result["metrics"]["n_p"].get<std::size_t>());
  EXPECT_EQ(result["sphere_parts"].size(), result["spheres"].size());
  for (const char* const word : {"torso", "left_leg", "n_p", "E_r", "E_M", "coverage", "circle"}) {
    EXPECT_THAT(last_out_, HasSubstr(word));
  }
}

TEST_F(CommandLine, EvaluateMeasuresWhatApproximateSaid) {
  const ordered_json result = Approximate({"--local"});
  const Outcome outcome = RunCapfit({"evaluate", Body(), Path("result.json"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto metrics = ordered_json::parse(outcome.out);
  EXPECT_EQ(metrics["n_p"], result["metrics"]["n_p"]);
  EXPECT_NEAR(metrics["E_r"].get<double>(), result["metrics"]["E_r"].get<double>(), 1e-9);
  EXPECT_NEAR(metrics["E_M"].get<double>(), result["metrics"]["E_M"].get<double>(), 1e-6);
}

TEST_F(CommandLine, AnimateMovesTheCentresWithTheBody) {
  const ordered_json result = Approximate({"--local", "--skinning", "dense"});
  // Two frames: the body at rest, and moved by (1, 2, 3).
  std::string frames;
  const std::string text = ReadText(Body());
  for (const float shift : {0.0F, 1.0F}) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("v ", 0) != 0) continue;
      std::istringstream numbers(line.substr(2));
      for (const float axis : {1.0F, 2.0F, 3.0F}) {
        double value = 0.0;
        numbers >> value;
        const float moved = static_cast<float>(value) + shift * axis;
        frames.append(reinterpret_cast<const char*>(&moved), sizeof(moved));
      }
    }
  }
  WriteText(Path("frames.bin"), frames);
  const Outcome outcome = RunCapfit({"animate", Body(), Path("result.json"), "--frames",
                                     Path("frames.bin"), "-o", Path("centers.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto centers = ordered_json::parse(ReadText(Path("centers.json")))["frames"];
  ASSERT_EQ(centers.size(), 2U);
  for (std::size_t i = 0; i < result["spheres"].size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double rest = result["spheres"][i][axis].get<double>();
      EXPECT_NEAR(centers[0][i][axis].get<double>(), rest, 2e-6);
      EXPECT_NEAR(centers[1][i][axis].get<double>(), rest + static_cast<double>(axis + 1), 2e-6);
    }
  }
}

TEST_F(CommandLine, OptionsThatMakeNoSenseAreRefusedNotIgnored) {
  for (const auto& option : std::vector<std::vector<std::string>>{
           {"--engine", "quake"}, {"--fit", "best", "--tolerance-mm", "1"}}) {
    for (const auto& place :
         std::vector<std::vector<std::string>>{{"--local"}, {"--server", server_->address()}}) {
      std::vector<std::string> arguments = {"approximate", Body(), "-o", Path("refused.json")};
      arguments.insert(arguments.end(), option.begin(), option.end());
      arguments.insert(arguments.end(), place.begin(), place.end());
      const Outcome outcome = RunCapfit(arguments);
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_THAT(outcome.err,
                  HasSubstr("INVALID_ARGUMENT: " + option[option.size() - 2].substr(2, 6)));
      EXPECT_EQ(ReadText(Path("refused.json")), "");
    }
  }
}

TEST_F(CommandLine, WrongFilesEndWithCodeAndMessageInBothPlaces) {
  WriteText(Path("cube.obj"),
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
            "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
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
  EXPECT_EQ(RunCapfit({"approximate", Body(), "-o", Path("r.json"), "--server", server_->address(),
                       "--timeout", "0.002"})
                .exit_code,
            3);
}

}  // namespace
}  // namespace capfit::e2e
