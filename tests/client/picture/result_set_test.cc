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
          "metrics": {"E_r": 0.25, "note": "text"}, "stages": {}, "warnings": []})");
  ASSERT_TRUE(set.ok()) << set.status();
  EXPECT_EQ(set->spheres.size(), 2u);
  EXPECT_EQ(set->spheres[0].radius_m, 0.5);
  EXPECT_EQ(set->capsules[0][1], 1);
  EXPECT_EQ(set->sphere_parts[1], "head");
  EXPECT_EQ(set->landmarks.at("neck").y(), 1.4);
  EXPECT_EQ(set->metrics.size(), 1u);
}

TEST(ResultSetTest, PartsAreOptional) {
  const auto set = ParseResultSet(R"({"spheres": [[0, 0, 0, 1]]})");
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->sphere_parts.size(), 1u);
  EXPECT_TRUE(set->capsules.empty());
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
        Case{"Landmark", R"({"spheres": [], "landmarks": {"neck": 3}})", "landmarks.neck",
             "3 numbers"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace capfit::client
