#include "client/result_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "client/picture/result_set.h"
#include "tests/server/fake_fit.h"

namespace capfit::client {
namespace {

using nlohmann::json;

TEST(ResultJson, HasTheShapeThatIsKeptForGood) {
  const json root = json::parse(FormatResult(server::HandMadeResult()));
  EXPECT_EQ(root["capsules"], json::parse("[[0, 1], [0, 2]]"));
  EXPECT_EQ(root["sphere_parts"], json::parse(R"(["torso", "left_arm", "right_arm"])"));
  EXPECT_EQ(root["landmarks"]["left_wrist"], json::parse("[0.5, 1.0, 0.2]"));
  EXPECT_EQ(root["warnings"][0]["code"], "HOLES_CLOSED");
  EXPECT_EQ(root["metrics"]["n_p"], 5);
  for (const char* const name : {"E_r", "outside", "uncovered", "E_M", "max_gap"}) {
    EXPECT_TRUE(root["metrics"][name].is_number()) << name;
  }
  EXPECT_EQ(root["stages"]["circle"], 0.4);
  EXPECT_FALSE(root["stages"].contains("refine")) << "took no time";
  EXPECT_EQ(root["seconds"], 3.8);
}

TEST(ResultJson, MembersKeepTheirOrder) {
  const auto root = nlohmann::ordered_json::parse(FormatResult(server::HandMadeResult()));
  std::vector<std::string> names;
  for (const auto& [name, value] : root.items()) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"spheres", "capsules", "sphere_parts", "landmarks",
                                      "warnings", "metrics", "stages", "seconds", "polygons"}));
}

TEST(ResultJson, EveryDoubleComesBackBitForBit) {
  pipeline::FitResult result = server::HandMadeResult();
  result.primitives.spheres[0] = {{1.0 / 3.0, std::nextafter(1.0, 2.0), -5e-324}, 0.1 + 0.2};
  const json sphere = json::parse(FormatResult(result))["spheres"][0];
  EXPECT_EQ(sphere[0].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(sphere[1].get<double>(), std::nextafter(1.0, 2.0));
  EXPECT_EQ(sphere[2].get<double>(), -5e-324);
  EXPECT_EQ(sphere[3].get<double>(), 0.1 + 0.2);
}

TEST(ResultJson, LengthsAreInTheUnitOfTheFile) {
  pipeline::FitResult result = server::HandMadeResult();  // 0.01 m per unit: centimetres
  EXPECT_DOUBLE_EQ(json::parse(FormatResult(result))["metrics"]["max_gap"].get<double>(), 0.2);
}

TEST(ResultJson, PartsHaveTheirOwnMetricsInTheUnitOfTheFile) {
  const json metrics = json::parse(FormatResult(server::HandMadeResult()))["metrics"];
  EXPECT_EQ(metrics["spheres"], 3);
  EXPECT_DOUBLE_EQ(metrics["gap"]["p95"].get<double>(), 7.0);
  EXPECT_EQ(metrics["iou"], 0.643);
  ASSERT_EQ(metrics["parts"].size(), 2U);
  const json arm = metrics["parts"]["left_arm"];
  EXPECT_EQ(arm["capsules"], 1);
  EXPECT_DOUBLE_EQ(arm["volume"].get<double>(), 4300.0);  // cubic centimetres
  EXPECT_EQ(arm["E_r"], 0.61);
  EXPECT_EQ(arm["volume_ratio"], 1.35);
  EXPECT_DOUBLE_EQ(arm["gap"]["mean"].get<double>(), 3.8);
  EXPECT_EQ(arm["vertices_out"], 2);
  EXPECT_DOUBLE_EQ(arm["max_out"].get<double>(), 0.04);
}

TEST(ResultJson, WithoutPartsTheirObjectIsEmpty) {
  EXPECT_EQ(json::parse(FormatMetrics(metrics::Metrics(), 1.0))["parts"], json::object());
}

TEST(ResultJson, AnEmptyResultAndNamesOfAnyBytesAreValidJson) {
  pipeline::FitResult result;
  EXPECT_EQ(json::parse(FormatResult(result))["spheres"], json::array());
  result.warnings.push_back({"X", "\xff\x01 \"quoted\"", 0});
  EXPECT_TRUE(json::parse(FormatResult(result), nullptr, false).is_object());
}

TEST(ResultJson, IsReadByTheCommandsThatTakeResults) {
  const auto set = ParseResultSet(FormatResult(server::HandMadeResult()));
  ASSERT_TRUE(set.ok()) << set.status();
  EXPECT_EQ(set->spheres.size(), 3U);
  EXPECT_EQ(set->capsules.size(), 2U);
  EXPECT_EQ(set->sphere_parts[1], "left_arm");
}

}  // namespace
}  // namespace capfit::client
