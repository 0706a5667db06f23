// Several servers, many calls: replicas that end, catalogues, and starts that must fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/e2e/processes.h"

namespace capfit::e2e {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

// `capfit load` of small bodies on both servers, one of which gets `signal` on the way. What the
// load found, its exit code first.
std::pair<int, Json> LoadWhileOneEnds(int signal, const std::vector<std::string>& server_flags,
                                      const std::vector<std::string>& load_flags) {
  ServerProcess first(server_flags);
  const ServerProcess second(server_flags);
  const Scratch scratch;
  std::vector<std::string> words = {"load",
                                    "--server",
                                    first.address() + "," + second.address(),
                                    "--faces",
                                    "2000",
                                    "--parts",
                                    "torso",
                                    "--max-primitives",
                                    "15",
                                    "--duration",
                                    "6",
                                    "--clients",
                                    "4",
                                    "--strict",
                                    "--json",
                                    scratch.Path("load.json")};
  words.insert(words.end(), load_flags.begin(), load_flags.end());
  Outcome outcome;
  std::thread load([&] { outcome = RunCapfit(words); });
  std::this_thread::sleep_for(std::chrono::seconds(2));
  first.Signal(signal);
  load.join();
  if (signal == SIGTERM) {
    EXPECT_EQ(first.Wait(), 0);
  }
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  return {outcome.exit_code, Json::parse(ReadText(scratch.Path("load.json")))};
}

TEST(Replicas, OneThatIsKilledFailsNoUnaryCall) {
  const auto [exit_code, load] = LoadWhileOneEnds(SIGKILL, {}, {"--attempts", "4"});
  EXPECT_GT(load["codes"]["OK"], 10);
  EXPECT_EQ(load["codes"].size(), 1U) << load;
  EXPECT_EQ(load["differing_results"], 0);
}

TEST(Replicas, StreamsThatBreakAreSentAgainAndGiveTheSameBits) {
  const auto [exit_code, load] = LoadWhileOneEnds(SIGKILL, {}, {"--attempts", "4", "--stream"});
  EXPECT_EQ(load["codes"].size(), 1U) << load;
  EXPECT_EQ(load["differing_results"], 0);
}

TEST(Replicas, OneThatStopsInOrderFailsNoCallEvenWithoutRepeats) {
  for (const std::vector<std::string>& kind : {std::vector<std::string>{}, {"--stream"}}) {
    std::vector<std::string> flags = {"--attempts", "1"};
    flags.insert(flags.end(), kind.begin(), kind.end());
    const auto [exit_code, load] = LoadWhileOneEnds(SIGTERM, {"--drain-delay-seconds", "1"}, flags);
    EXPECT_EQ(load["codes"].size(), 1U) << load;
  }
}

TEST(Load, TellsRefusalsFromFailures) {
  const ServerProcess server({"--max-concurrent-fits", "1", "--max-queued-fits", "0"});
  const std::vector<std::string> words = {
      "load", "--server", server.address(), "--faces", "2000", "--duration", "3", "--clients", "6"};
  const Outcome lenient = RunCapfit(words);
  EXPECT_EQ(lenient.exit_code, 0) << lenient.out << lenient.err;
  EXPECT_THAT(lenient.out, HasSubstr("RESOURCE_EXHAUSTED"));
  std::vector<std::string> strict = words;
  strict.push_back("--strict");
  EXPECT_EQ(RunCapfit(strict).exit_code, 3);
  const Outcome nobody = RunCapfit({"load", "--server", "127.0.0.1:1", "--faces", "2000",
                                    "--duration", "0.2", "--clients", "1"});
  EXPECT_EQ(nobody.exit_code, 3) << nobody.out;
}

TEST(Load, ARateIsKeptWhateverTheServerDoes) {
  const ServerProcess server;
  const Scratch scratch;
  const Outcome outcome =
      RunCapfit({"load", "--server", server.address(), "--faces", "2000,3000", "--duration", "2",
                 "--rate", "5", "--json", scratch.Path("load.json")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Json load = Json::parse(ReadText(scratch.Path("load.json")));
  EXPECT_EQ(load["answered"]["calls"].get<int>() + load["refused"]["calls"].get<int>(), 10);
  EXPECT_EQ(load["bodies"].size(), 2U);
}

class Batch : public testing::Test {
 protected:
  Batch() {
    std::filesystem::create_directories(scratch_.Path("bodies/more"));
    for (const char* const name : {"bodies/a.obj", "bodies/b.ply", "bodies/more/a.obj"}) {
      EXPECT_EQ(RunCapfit({"mannequin", "-o", scratch_.Path(name), "--faces", "2000"}).exit_code,
                0);
    }
  }

  Outcome Run(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"batch", scratch_.Path("bodies"), "-o", scratch_.Path("results"),
                               "--server", server_.address(), "--parts", "torso"});
    return RunCapfit(more);
  }

  Scratch scratch_;
  ServerProcess server_;
};

TEST_F(Batch, FitsEachBodyOnceAndGoesOnWhereItWasBrokenOff) {
  EXPECT_THAT(Run({"--share", "0/2"}).out, HasSubstr("2 of 2 bodies: 2 fitted"));
  EXPECT_THAT(Run().out, HasSubstr("3 of 3 bodies: 1 fitted, 2 there already, 0 failed"));
  EXPECT_EQ(Json::parse(ReadText(scratch_.Path("results/more/a.obj.json")))["format"],
            "capfit-result");
  // Other options, and another body under the same name, are other jobs.
  EXPECT_THAT(Run({"--max-primitives", "20"}).out, HasSubstr("3 fitted"));
  WriteText(scratch_.Path("bodies/a.obj"), ReadText(scratch_.Path("bodies/a.obj")) + "# new\n");
  EXPECT_THAT(Run({"--max-primitives", "20"}).out, HasSubstr("1 fitted, 2 there already"));
}

TEST_F(Batch, FailuresAreListedAndTheOthersDone) {
  WriteText(scratch_.Path("bodies/broken.obj"), "v 1 2\n");
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, HasSubstr("3 fitted, 0 there already, 1 failed"));
  EXPECT_THAT(outcome.err, HasSubstr("broken.obj: INVALID_ARGUMENT: mesh.file"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.Path("results/broken.obj.json")));
}

TEST_F(Batch, WhatCannotBeDoneIsSaid) {
  EXPECT_EQ(Run({"--share", "2/2"}).exit_code, 2);
  const Outcome dense = Run({"--skinning", "dense"});
  EXPECT_EQ(dense.exit_code, 2);
  EXPECT_THAT(dense.err, HasSubstr("batch writes RESULT.json files alone"));
  // Not among its flags.
  EXPECT_THAT(RunCapfit({"batch", "--help"}).out, testing::Not(HasSubstr("--heat-map")));
  EXPECT_EQ(Run({"--heat-map"}).exit_code, 1);
  EXPECT_EQ(Run({"--export", "csv"}).exit_code, 1);
  EXPECT_EQ(RunCapfit({"batch", scratch_.Path("none"), "-o", scratch_.Path("r")}).exit_code, 1);
}

Outcome RunServer(const std::vector<std::string>& flags) {
  return RunProgram(CAPFIT_SERVER_PROGRAM, flags);
}

TEST(ServerStart, EndsWithAMessageWhereItCannotServe) {
  const ServerProcess other;
  const Outcome busy = RunServer({"--listen", other.address()});
  EXPECT_EQ(busy.exit_code, 3);
  EXPECT_THAT(busy.err, HasSubstr("cannot listen on " + other.address()));
  const Outcome open = RunServer({"--listen", "0.0.0.0:0"});
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_THAT(open.err, HasSubstr("--insecure-listen"));
  const Outcome bad = RunServer({"--tls-certificate", "/nowhere", "--tls-key", "/nowhere"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, HasSubstr("/nowhere cannot be read"));
}

TEST(ServerStart, ALogOnAFullDiskStopsNothing) {
  ServerProcess server({"--log-level", "trace"}, "/dev/full");
  const Scratch scratch;
  const std::string body = scratch.Path("body.obj");
  ASSERT_EQ(RunCapfit({"mannequin", "-o", body, "--faces", "2000"}).exit_code, 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(RunCapfit({"approximate", body, "-o", scratch.Path("r.json"), "--server",
                         server.address(), "--quiet"})
                  .exit_code,
              0);
  }
  server.Signal(SIGTERM);
  EXPECT_EQ(server.Wait(), 0);
}

TEST(ServerStart, ChannelzIsOnlyForThisMachineOrForCertificates) {
  const Outcome open = RunServer({"--listen", "0.0.0.0:0", "--insecure-listen", "--channelz"});
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_THAT(open.err, HasSubstr("--channelz tells everybody who calls"));
  const ServerProcess server({"--channelz"});
  EXPECT_EQ(RunCapfit({"info", "--server", server.address()}).exit_code, 0);
}

}  // namespace
}  // namespace capfit::e2e
