#include "client/result_json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/landmarks_file.h"
#include "client/picture/result_set.h"
#include "tests/server/fake_fit.h"

namespace capfit::client {
namespace {

using nlohmann::json;

// A result of which every member is there and has a value of its own.
pipeline::FitResult WholeResult() {
  pipeline::FitResult result = server::HandMadeResult();
  result.sphere_names = {"chest_1", "left_upper_arm_1", "right_upper_arm_1"};
  result.sphere_places = {
      refine::BodyPlace{refine::BoneId::kChest, refine::Side::kLeft, {0.5, 0.0, -0.25}, 1.5},
      std::nullopt,
      refine::BodyPlace{refine::BoneId::kUpperArm, refine::Side::kRight, {0.0, 0.0, 0.0}, 1.0}};
  result.effective_options.max_primitives = 64;
  result.effective_options.unit = body::Unit::kCentimetre;
  result.effective_options.up = body::UpAxis::kZ;
  result.effective_options.want_polygons = true;
  return result;
}

std::vector<std::string> NamesOf(const nlohmann::ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

// The names of the message's fields, in their order.
std::vector<std::string> NamesOf(const google::protobuf::Descriptor& message) {
  std::vector<std::string> names;
  for (int i = 0; i < message.field_count(); ++i) names.push_back(message.field(i)->name());
  return names;
}

TEST(ResultJson, HasTheShapeThatIsKeptForGood) {
  const json root = json::parse(FormatResult(WholeResult()));
  EXPECT_EQ(root["format"], "capfit-result");
  EXPECT_EQ(root["format_version"], 1);
  EXPECT_EQ(root["metres_per_unit"], 0.01);
  EXPECT_EQ(root["body_from_caller"],
            json::parse(R"({"rotation": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
                            "scale": 0.01, "translation": [1.0, 2.0, 3.0]})"));
  EXPECT_EQ(root["spheres"][1], json::parse("[1.0, 2.0, 3.0, 0.5]"));
  EXPECT_EQ(root["capsules"], json::parse("[[0, 1], [0, 2]]"));
  EXPECT_EQ(root["sphere_names"],
            json::parse(R"(["chest_1", "left_upper_arm_1", "right_upper_arm_1"])"));
  EXPECT_EQ(root["sphere_parts"], json::parse(R"(["torso", "left_arm", "right_arm"])"));
  EXPECT_EQ(root["sphere_mirrors"], json::parse("[0, 2, 1]"));
  EXPECT_EQ(root["sphere_places"][0],
            json::parse(R"({"bone": "chest", "is_right": false, "along": 0.5, "aside": 0.0,
                            "ahead": -0.25, "radius": 1.5})"));
  EXPECT_TRUE(root["sphere_places"][1].is_null());
  EXPECT_EQ(root["sphere_polygons"], json::parse("[4, 7, null]"));
  EXPECT_EQ(root["capsule_parts"], json::parse(R"(["left_arm", "right_arm"])"));
  EXPECT_EQ(root["landmarks"]["left_wrist"],
            json::parse(R"({"position": [0.5, 1.0, 0.2], "method": "caller", "confidence": 1.0})"));
  EXPECT_EQ(root["warnings"], json::parse(R"([{"code": "HOLES_CLOSED",
                                               "message": "2 holes were closed", "count": 2}])"));
  EXPECT_EQ(root["stages"]["circle"], 0.4);
  EXPECT_FALSE(root["stages"].contains("coverage")) << "took no time";
  EXPECT_EQ(root["seconds"], 3.8);
  EXPECT_EQ(root["feature_polygons"], json::parse(R"([{"name": "hip", "part": "torso",
      "outline": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
      "circles": [[0.2, 0.0, 0.2, 0.3]], "outside_area_ratio": 0.17}])"));
}

TEST(ResultJson, MembersKeepTheirOrder) {
  const auto root = nlohmann::ordered_json::parse(FormatResult(WholeResult(), "job 7"));
  EXPECT_EQ(NamesOf(root),
            (std::vector<std::string>{"format",        "format_version",   "version",
                                      "unit",          "metres_per_unit",  "up_axis",
                                      "request_id",    "body_from_caller", "body",
                                      "options",       "spheres",          "capsules",
                                      "sphere_names",  "sphere_parts",     "sphere_mirrors",
                                      "sphere_places", "sphere_polygons",  "capsule_parts",
                                      "landmarks",     "warnings",         "metrics",
                                      "stages",        "seconds",          "feature_polygons"}));
  EXPECT_EQ(root["request_id"], "job 7");
}

TEST(ResultJson, NothingIsSaidOfWhatWasNotAskedFor) {
  pipeline::FitResult result = WholeResult();
  result.polygons.clear();
  EXPECT_EQ(json::parse(FormatResult(result))["feature_polygons"], json::array()) << "asked for";
  result.effective_options.want_polygons = false;
  const json root = json::parse(FormatResult(result));
  for (const char* const name : {"feature_polygons", "sphere_polygons", "request_id"}) {
    EXPECT_FALSE(root.contains(name)) << name;
  }
}

TEST(ResultJson, HasTheNamesOfTheContract) {
  const auto root = nlohmann::ordered_json::parse(FormatResult(WholeResult()));
  EXPECT_EQ(NamesOf(root["metrics"]), NamesOf(*v1::Metrics::descriptor()));
  EXPECT_EQ(NamesOf(root["metrics"]["gap"]), NamesOf(*v1::GapStatistics::descriptor()));
  std::vector<std::string> part = NamesOf(*v1::PartMetrics::descriptor());
  part.erase(part.begin());  // "part": the name under which it stands
  EXPECT_EQ(NamesOf(root["metrics"]["parts"]["torso"]), part);
  EXPECT_EQ(NamesOf(root["options"]), NamesOf(*v1::EffectiveOptions::descriptor()));
  EXPECT_EQ(NamesOf(root["body"]), NamesOf(*v1::BodyFacts::descriptor()));
  EXPECT_EQ(NamesOf(root["body_from_caller"]), NamesOf(*v1::Similarity::descriptor()));
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

TEST(ResultJson, MetricsAreInMetresAndTellTheParts) {
  // A body in centimetres: no figure depends on it.
  const json metrics = json::parse(FormatResult(WholeResult()))["metrics"];
  EXPECT_EQ(metrics["primitive_count"], 5);
  EXPECT_EQ(metrics["sphere_count"], 3);
  EXPECT_EQ(metrics["volume_error"], 0.5);
  EXPECT_EQ(metrics["mean_distance_percent"], 1.5);
  EXPECT_EQ(metrics["max_distance_percent"], 6.5);
  EXPECT_EQ(metrics["max_gap_m"], 0.002);
  EXPECT_EQ(metrics["gap"], json::parse(R"({"mean_m": 0.03, "p95_m": 0.07, "max_m": 0.13})"));
  EXPECT_EQ(metrics["intersection_over_union"], 0.643);
  ASSERT_EQ(metrics["parts"].size(), 2U);
  const json arm = metrics["parts"]["left_arm"];
  EXPECT_EQ(arm["capsule_count"], 1);
  EXPECT_EQ(arm["volume_m3"], 0.0043);
  EXPECT_EQ(arm["volume_error"], 0.61);
  EXPECT_EQ(arm["vertices_out"], 2);
  EXPECT_EQ(arm["max_out_m"], 0.0004);
}

TEST(ResultJson, WithoutPartsTheirObjectIsEmpty) {
  EXPECT_EQ(json::parse(FormatMetrics(metrics::Metrics()))["parts"], json::object());
}

TEST(ResultJson, LinesAreShortAndListsOfWordsStayWhole) {
  std::istringstream lines(FormatResult(WholeResult()));
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("\"sphere_") == std::string::npos) longest = std::max(longest, line.size());
  }
  EXPECT_LE(longest, 100U);
  EXPECT_GT(longest, 60U);
  EXPECT_NE(FormatResult(WholeResult()).find("\n  \"sphere_mirrors\": [0,2,1],\n"),
            std::string::npos);
}

TEST(ResultJson, AnEmptyResultAndNamesOfAnyBytesAreValidJson) {
  pipeline::FitResult result;
  EXPECT_EQ(json::parse(FormatResult(result))["spheres"], json::array());
  result.warnings.push_back({"X", "\xff\x01 \"quoted\"", 0});
  EXPECT_TRUE(json::parse(FormatResult(result), nullptr, false).is_object());
}

TEST(ResultJson, IsReadByTheCommandsThatTakeResults) {
  const auto set = ParseResultSet(FormatResult(WholeResult()));
  ASSERT_TRUE(set.ok()) << set.status();
  EXPECT_EQ(set->spheres.size(), 3U);
  EXPECT_EQ(set->capsules.size(), 2U);
  EXPECT_EQ(set->sphere_parts[1], "left_arm");
  EXPECT_EQ(set->sphere_names[2], "right_upper_arm_1");
  EXPECT_EQ(set->sphere_mirrors, (std::vector<int>{0, 2, 1}));
  EXPECT_EQ(set->sphere_places[0]->place.ahead, -0.25);
  EXPECT_FALSE(set->sphere_places[1].has_value());
  EXPECT_EQ(set->sphere_places[2]->side, refine::Side::kRight);
  EXPECT_EQ(set->metrics.at("volume_error"), 0.5);
  EXPECT_EQ(set->landmarks.at("left_wrist"), Eigen::Vector3d(0.5, 1.0, 0.2));
  EXPECT_EQ(set->metres_per_unit, 0.01);
  ASSERT_TRUE(set->body);
  ASSERT_EQ(set->polygons.size(), 1U);
  EXPECT_EQ(set->polygons[0].part, "torso");
  EXPECT_EQ(set->polygons[0].outline[1], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(set->polygons[0].circles[0].radius_m, 0.3);
  EXPECT_EQ(set->polygons[0].outside_area_ratio, 0.17);
  const auto landmarks = ParseLandmarks(FormatResult(WholeResult()));
  ASSERT_TRUE(landmarks.ok()) << landmarks.status();
  EXPECT_EQ(landmarks->at(body::LandmarkId::kNeck), Eigen::Vector3d(0.0, 1.4, 0.1));
}

}  // namespace
}  // namespace capfit::client
