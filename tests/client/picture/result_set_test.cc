#include "client/picture/result_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "core/base/status.h"

namespace capfit::client {
namespace {

using testing::HasSubstr;

TEST(ResultSetTest, ReadsAllFieldsAndIgnoresOthers) {
  const auto set = ParseResultSet(
      R"({"spheres": [[1, 2, 3, 0.5], [1, 3, 3, 0]], "capsules": [[0, 1]],
          "sphere_parts": ["torso", "head"], "landmarks": {"neck": [0, 1.4, 0]},
          "metrics": {"volume_error": 0.25, "note": "text"}, "stages": {}, "warnings": []})");
  ASSERT_TRUE(set.ok()) << set.status();
  EXPECT_EQ(set->spheres.size(), 2u);
  EXPECT_EQ(set->spheres[0].radius_m, 0.5);
  EXPECT_EQ(set->capsules[0][1], 1);
  EXPECT_EQ(set->sphere_parts[1], "head");
  EXPECT_EQ(set->landmarks.at("neck").y(), 1.4);
  EXPECT_EQ(set->metrics.size(), 1u);
}

TEST(ResultSetTest, ReadsWhatOnlyCapfitWrites) {
  const auto set = ParseResultSet(
      R"({"format": "capfit-result", "format_version": 1, "unit": "centimetre",
          "metres_per_unit": 0.01, "options": {"parts": ["arms", "feet"]},
          "body": {"vertex_count": 7, "box_min": [0, 1, 2], "box_max": [3, 4, 5]},
          "spheres": [[1, 2, 3, 0.5]], "sphere_names": ["left_foot_1"],
          "landmarks": {"neck": {"position": [0, 1.4, 0], "method": "measured"}},
          "feature_polygons": [{"name": "hip", "part": "torso", "outline": [[0, 0, 0]],
                                "circles": [[1, 1, 1, 2]], "outside_area_ratio": 0.5}]})");
  ASSERT_TRUE(set.ok()) << set.status();
  EXPECT_EQ(set->unit, "centimetre");
  EXPECT_EQ(set->metres_per_unit, 0.01);
  EXPECT_EQ(set->body->vertex_count, 7);
  EXPECT_EQ(set->body->box_max, Eigen::Vector3d(3, 4, 5));
  EXPECT_TRUE(set->parts->arms && set->parts->feet);
  EXPECT_FALSE(set->parts->torso || set->parts->legs || set->parts->head || set->parts->hands);
  EXPECT_EQ(set->sphere_names[0], "left_foot_1");
  EXPECT_EQ(set->landmarks.at("neck").y(), 1.4);
  EXPECT_EQ(set->polygons.at(0).circles.at(0).radius_m, 2.0);
}

TEST(ResultSetTest, PartsAreOptional) {
  const auto set = ParseResultSet(R"({"spheres": [[0, 0, 0, 1]]})");
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->sphere_parts.size(), 1u);
  EXPECT_TRUE(set->capsules.empty());
  EXPECT_FALSE(set->body || set->parts || set->metres_per_unit);
}

struct Case {
  std::string name;
  std::string text;
  std::string field;
  std::string problem;
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};

class ResultSetErrorTest : public testing::TestWithParam<Case> {};

TEST_P(ResultSetErrorTest, NamesTheField) {
  const auto set = ParseResultSet(GetParam().text);
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(FieldOf(set.status()), GetParam().field);
  EXPECT_THAT(std::string(set.status().message()), HasSubstr(GetParam().problem));
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, ResultSetErrorTest,
    testing::Values(
        Case{"Empty", "", "result", "JSON"}, Case{"Cut", R"({"spheres": [[0)", "result", "JSON"},
        Case{"Array", "[]", "result", "object"}, Case{"NoSpheres", "{}", "spheres", "missing"},
        Case{"Short", R"({"spheres": [[0, 0, 0]]})", "spheres[0]", "4 numbers"},
        Case{"Word", R"({"spheres": [[0, 0, 0, 1], [0, 0, "x", 1]]})", "spheres[1]", "finite"},
        Case{"Null", R"({"spheres": [[0, 0, null, 1]]})", "spheres[0]", "finite"},
        Case{"Radius", R"({"spheres": [[0, 0, 0, -1]]})", "spheres[0]", "negative"},
        Case{"Index", R"({"spheres": [[0, 0, 0, 1]], "capsules": [[0, 1]]})", "capsules[0][1]",
             "is 1, must be a whole number below 1"},
        Case{"Fraction", R"({"spheres": [[0, 0, 0, 1]], "capsules": [[0.5, 0]]})", "capsules[0][0]",
             "whole"},
        Case{"Parts", R"({"spheres": [[0, 0, 0, 1]], "sphere_parts": []})", "sphere_parts",
             "1 words"},
        Case{"LaterFormat", R"({"format": "capfit-result", "format_version": 2, "spheres": []})",
             "format_version", "is 2, this capfit reads 1"},
        Case{"NoUnit", R"({"format": "capfit-result", "format_version": 1, "spheres": []})",
             "metres_per_unit", "> 0"},
        Case{"NoBody", R"({"format": "capfit-result", "format_version": 1, "metres_per_unit": 1})",
             "body", "missing"},
        Case{"Polygon", R"({"spheres": [], "feature_polygons": [{"name": "hip"}]})",
             "feature_polygons[0]", "outline"},
        Case{"Circle",
             R"({"spheres": [], "feature_polygons": [{"outline": [], "circles": [[1]]}]})",
             "feature_polygons[0].circles[0]", "4 numbers"},
        Case{"Landmark", R"({"spheres": [], "landmarks": {"neck": 3}})", "landmarks.neck",
             "3 numbers"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace capfit::client
