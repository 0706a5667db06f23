// The command line as a user runs it, alone and against a server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>

#include "absl/strings/str_split.h"
#include "tests/client/picture/read_png.h"
#include "tests/e2e/processes.h"
#include "tests/server/certificates.h"
#include "tests/support/avatars.h"

namespace capfit::e2e {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

constexpr char kCube[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

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

  static ordered_json Read(const std::string& path) { return ordered_json::parse(ReadText(path)); }

  // The same OBJ file with every coordinate times 100.
  static std::string InCentimetres(const std::string& obj) {
    std::istringstream lines(obj);
    std::ostringstream text;
    text.precision(12);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string kind;
      double x = 0.0, y = 0.0, z = 0.0;
      if (words >> kind; kind == "v" && words >> x >> y >> z) {
        text << "v " << 100.0 * x << " " << 100.0 * y << " " << 100.0 * z << "\n";
      } else {
        text << line << "\n";
      }
    }
    return text.str();
  }

  // All that must not depend on where and with how many threads it was computed.
  static std::string Bits(const ordered_json& result) {
    std::string bits;
    for (const char* const member :
         {"spheres", "capsules", "sphere_names", "sphere_parts", "sphere_mirrors",
          "sphere_polygons", "capsule_parts", "landmarks", "warnings", "metrics",
          "feature_polygons", "options", "body", "body_from_caller", "unit", "version"}) {
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

TEST_F(CommandLine, ASetWithoutSpheresIsNotPerfect) {
  WriteText(Path("empty.json"), R"({"spheres": [], "capsules": []})");
  const Outcome outcome = RunCapfit({"evaluate", Body(), Path("empty.json")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("empty.json has no spheres"));
}

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
  // The same in the other form, through the standard streams; both are what render reads.
  const Outcome binary = RunCapfit(
      {"animate", Body(), Path("result.json"), "--frames", "-", "-o", "-"}, Path("frames.bin"));
  ASSERT_EQ(binary.exit_code, 0) << binary.err;
  EXPECT_EQ(binary.out.size(), 2 * 12 * result["spheres"].size());
  EXPECT_THAT(binary.err, HasSubstr("2 frames of"));
  WriteText(Path("centers.f32"), binary.out);
  std::vector<std::string> pictures;
  for (const char* const name : {"centers.json", "centers.f32"}) {
    const Outcome drawn = RunCapfit({"render", Body(), Path("result.json"), "--frames",
                                     Path("frames.bin"), "--centers", Path(name), "--show", "0",
                                     "1", "-o", "-", "--width", "400", "--height", "300"});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    pictures.push_back(drawn.out);
  }
  EXPECT_THAT(pictures[0], testing::StartsWith("\x89PNG"));
  EXPECT_EQ(pictures[0], pictures[1]);
}

// All joints one step to the side: spheres and capsules go with them, and at rest stand as fitted.
TEST_F(CommandLine, AnimateHangsEachSphereAndCapsuleOnOneJoint) {
  CAPFIT_REQUIRE_AVATARS();
  const std::string body = (test_support::AvatarsFolder() / "skirt_woman.glb").string();
  ASSERT_EQ(RunCapfit({"approximate", body, "-o", Path("result.json"), "--local"}).exit_code, 0);
  const ordered_json result = ordered_json::parse(ReadText(Path("result.json")));
  std::string frames;
  for (const float shift : {0.0F, 1.0F}) {
    for (const ordered_json& joint : result["joints"]) {
      for (std::size_t k = 0; k < 12; ++k) {
        const float number = joint["to_mesh"][k].get<float>() + (k == 3 ? shift : 0.0F);
        frames.append(reinterpret_cast<const char*>(&number), sizeof(number));
      }
    }
  }
  WriteText(Path("joints.bin"), frames);
  const Outcome outcome =
      RunCapfit({"animate", body, Path("result.json"), "--joints", Path("joints.bin"),
                 "--one-joint", "-o", Path("c.json"), "--capsule-ends", Path("e.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto centers = ordered_json::parse(ReadText(Path("c.json")))["frames"];
  const auto ends = ordered_json::parse(ReadText(Path("e.json")))["frames"];
  const auto same = [&](const ordered_json& point, std::size_t sphere, double shift) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double rest = result["spheres"][sphere][axis].get<double>();
      EXPECT_NEAR(point[axis].get<double>(), rest + (axis == 0 ? shift : 0.0), 3e-6);
    }
  };
  for (std::size_t f = 0; f < 2; ++f) {
    const auto shift = static_cast<double>(f);
    ASSERT_EQ(centers[f].size(), result["spheres"].size());
    ASSERT_EQ(ends[f].size(), 2 * result["capsules"].size());
    for (std::size_t i = 0; i < centers[f].size(); ++i) same(centers[f][i], i, shift);
    for (std::size_t k = 0; k < ends[f].size(); ++k) {
      same(ends[f][k], result["capsules"][k / 2][k % 2].get<std::size_t>(), shift);
    }
  }
  // Without a skeleton there is no joint to hang on.
  static_cast<void>(Approximate({"--local"}));
  const Outcome refused = RunCapfit({"animate", Body(), Path("result.json"), "--joints",
                                     Path("joints.bin"), "--one-joint", "-o", Path("c.json")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("came with a skeleton"));
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

}  // namespace
}  // namespace capfit::e2e
