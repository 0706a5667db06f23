// The command line as a user runs it: what its tests share.
#ifndef CAPFIT_TESTS_E2E_COMMAND_LINE_H_
#define CAPFIT_TESTS_E2E_COMMAND_LINE_H_

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/e2e/processes.h"

namespace capfit::e2e {

// One mannequin and one server for all tests.
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
  static nlohmann::ordered_json Approximate(const std::vector<std::string>& flags) {
    std::vector<std::string> arguments = {"approximate", Body(), "-o", Path("result.json")};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Outcome outcome = RunCapfit(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    last_out_ = outcome.out;
    return nlohmann::ordered_json::parse(ReadText(Path("result.json")), nullptr, false);
  }

  static nlohmann::ordered_json Read(const std::string& path) {
    return nlohmann::ordered_json::parse(ReadText(path));
  }

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
  static std::string Bits(const nlohmann::ordered_json& result) {
    std::string bits;
    for (const char* const member :
         {"spheres", "capsules", "sphere_names", "sphere_parts", "sphere_mirrors",
          "sphere_polygons", "capsule_parts", "landmarks", "warnings", "metrics",
          "feature_polygons", "options", "body", "body_from_caller", "unit", "version"}) {
      if (result.contains(member)) bits += result[member].dump() + "\n";
    }
    return bits;
  }

  inline static Scratch* scratch_ = nullptr;
  inline static ServerProcess* server_ = nullptr;
  inline static std::string last_out_;
};

}  // namespace capfit::e2e

#endif  // CAPFIT_TESTS_E2E_COMMAND_LINE_H_
