// The command line as a user runs it, alone and against a server.
#include "tests/e2e/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/client/picture/read_png.h"

namespace capfit::e2e {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

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
  EXPECT_LE(result["metrics"]["primitive_count"].get<int>(), 64);
  EXPECT_EQ(result["spheres"].size() + result["capsules"].size(),
            result["metrics"]["primitive_count"].get<std::size_t>());
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
  EXPECT_EQ(metrics["primitive_count"], result["metrics"]["primitive_count"]);
  EXPECT_NEAR(metrics["volume_error"].get<double>(),
              result["metrics"]["volume_error"].get<double>(), 1e-9);
  EXPECT_NEAR(metrics["mean_distance_percent"].get<double>(),
              result["metrics"]["mean_distance_percent"].get<double>(), 1e-6);
}

TEST_F(CommandLine, ExportsPrintTheOnlyFile) {
  Approximate({"--local"});
  const std::string result = Path("result.json");
  ASSERT_EQ(RunCapfit({"export", result, "--to", "jolt", "-o", Path("jolt")}).exit_code, 0);
  const Outcome printed = RunCapfit({"export", result, "--to", "jolt", "-o", "-"});
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_EQ(printed.out, ReadText(Path("jolt/jolt_colliders.json")));
  const Outcome two = RunCapfit({"export", result, "--to", "jolt,csv", "-o", "-"});
  EXPECT_EQ(two.exit_code, 2);
  EXPECT_THAT(two.err, HasSubstr("--output is -, which takes one file; these formats make 3"));
}

TEST_F(CommandLine, HeatMapsShowMillimetresOfBodiesInAnyUnit) {
  WriteText(Path("centimetres.obj"), InCentimetres(ReadText(Body())));
  const std::string body = Path("centimetres.obj");
  const std::string result = Path("centimetres.json");
  ASSERT_EQ(RunCapfit({"approximate", body, "-o", result, "--local", "--heat-map"}).exit_code, 0);
  EXPECT_EQ(Read(result)["unit"], "centimetre");
  WriteText(Path("foreign.json"), ordered_json{{"spheres", Read(result)["spheres"]},
                                               {"capsules", Read(result)["capsules"]}}
                                      .dump());
  const auto picture = [&](const std::string& set, const std::vector<std::string>& flags) {
    std::vector<std::string> words = {"render", body,       set,   "-o",      "-",    "--width",
                                      "400",    "--height", "400", "--views", "front"};
    words.insert(words.end(), flags.begin(), flags.end());
    const Outcome outcome = RunCapfit(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string right = picture(result, {"--heat", "--mm-per-unit", "10"});
  EXPECT_EQ(picture(result, {"--heat"}), right);
  const auto difference = [&](const std::vector<std::string>& flags) {
    return client::LargestDifference(client::ReadPng(picture(result, flags)),
                                     client::ReadPng(right));
  };
  EXPECT_LE(difference({"--gaps", Path("centimetres.gaps.json")}), 2) << "its gaps are floats";
  EXPECT_GT(difference({"--heat", "--mm-per-unit", "1000"}), 100);
  EXPECT_EQ(picture(Path("foreign.json"), {"--heat"}),
            picture(Path("foreign.json"), {"--heat", "--mm-per-unit", "10"}));
}

TEST_F(CommandLine, AMinusIsStandardInputAndOutput) {
  ASSERT_EQ(RunCapfit({"mannequin", "-o", Path("body.ply"), "--faces", "8000"}).exit_code, 0);
  for (const char* const name : {"body.obj", "body.ply"}) {
    const Outcome by_name = RunCapfit({"approximate", Path(name), "-o", "-", "--local"});
    ASSERT_EQ(by_name.exit_code, 0) << by_name.err;
    const std::string expected = ordered_json::parse(by_name.out)["spheres"].dump();
    for (const auto& place :
         std::vector<std::vector<std::string>>{{"--local"}, {"--server", server_->address()}}) {
      std::vector<std::string> words = {"approximate", "-", "-o", "-"};
      words.insert(words.end(), place.begin(), place.end());
      const Outcome outcome = RunCapfit(words, Path(name));
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(ordered_json::parse(outcome.out)["spheres"].dump(), expected) << name;
      EXPECT_THAT(outcome.err, HasSubstr("left_leg")) << "the table";
    }
  }
  const Outcome mannequin = RunCapfit({"mannequin", "-o", "-", "--faces", "8000"});
  EXPECT_EQ(mannequin.out, ReadText(Body()));
  Approximate({"--local"});  // writes result.json
  EXPECT_EQ(RunCapfit({"evaluate", Body(), "-", "--json"}, Path("result.json")).exit_code, 0);
  EXPECT_EQ(RunCapfit({"evaluate", "-", "-"}, Body()).exit_code, 2) << "one of them only";
  const Outcome beside = RunCapfit({"approximate", Body(), "-o", "-", "--local", "--heat-map"});
  EXPECT_EQ(beside.exit_code, 2);
  EXPECT_THAT(beside.err, HasSubstr("--heat-map writes files beside RESULT.json"));
}

TEST_F(CommandLine, InfoIsReadableAndJson) {
  const Outcome table = RunCapfit({"info", "--server", server_->address()});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  for (const char* const words : {"limits", "2000000", "mesh files: obj, ply, stl, off, glb",
                                  "nvcloth", "quality    paper, balanced, tight"}) {
    EXPECT_THAT(table.out, HasSubstr(words));
  }
  const Outcome json = RunCapfit({"info", "--server", server_->address(), "--json"});
  EXPECT_EQ(ordered_json::parse(json.out)["limits"]["max_vertices"], "2000000");
}

// What bash offers after these words.
std::string Completed(const std::string& words) {
  const std::string script = "source <(" CAPFIT_CLIENT_PROGRAM
                             " completion bash) || exit 1\n"
                             "COMP_WORDS=(" +
                             words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                             "_capfit; printf '%s ' \"${COMPREPLY[@]}\"\n";
  const Outcome outcome = RunProgram("/bin/bash", {"-c", script});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

TEST_F(CommandLine, BashCompletesCommandsFlagsWordsAndFiles) {
  EXPECT_EQ(Completed("capfit ap"), "approximate ");
  EXPECT_EQ(Completed("capfit e"), "evaluate export ");
  EXPECT_EQ(Completed("capfit approximate --max-p"), "--max-primitives ");
  EXPECT_EQ(Completed("capfit approximate b.obj --quality ''"), "paper balanced tight ");
  EXPECT_EQ(Completed("capfit approximate --parts le"), "legs ");
  EXPECT_EQ(Completed("capfit render --views ba"), "back-quarter back ");
  EXPECT_EQ(Completed("capfit completion ''"), "bash ");
  EXPECT_EQ(Completed("capfit approximate " + Path("body.o")), Body() + " ");
}

}  // namespace
}  // namespace capfit::e2e
