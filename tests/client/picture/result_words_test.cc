#include "client/picture/result_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/enum_index.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using testing::ElementsAre;
using testing::Field;

// A result of torso and arms of this program, with this rotation.
std::string OwnResult(const std::string& asked, const std::string& rotation) {
  return R"({"format": "capfit-result", "format_version": 1, "unit": "metre",
    "metres_per_unit": 1, "body_from_caller": {"rotation": )" +
         rotation + R"(, "scale": 1, "translation": [0, 0, 0]},
    "body": {"vertex_count": 9, "box_min": [0, 0, 0], "box_max": [1, 1, 1]},
    "options": {"quality": "tight", "engine": "physx", "parts": )" +
         asked + R"(},
    "spheres": [[0, 1, 0, 0.1], [0, 2, 0, 0.1], [1, 1, 0, 0.1]], "capsules": [[0, 1]],
    "sphere_parts": ["torso", "torso", "left_arm"],
    "metrics": {"primitive_count": 4, "volume_error": 0.25, "mean_distance_percent": 1.234,
                "parts": {"torso": {}, "left_arm": {}, "right_arm": {}}}})";
}
constexpr char kUpright[] = "[1, 0, 0, 0, 1, 0, 0, 0, 1]";

PartFlags AllParts() {
  PartFlags parts;
  parts.fill(true);
  return parts;
}

TEST(ResultWordsTest, CaptionSaysWhatTheResultTells) {
  EXPECT_EQ(Caption(*ParseResultSet(OwnResult(R"(["torso"])", kUpright))),
            "n_p 4     3 spheres + 1 capsules     E_r 0.250     E_M 1.23 %     quality tight     "
            "engine physx");
  EXPECT_EQ(Caption(*ParseResultSet(R"({"spheres": [[0, 0, 0, 1]]})")), "1 spheres + 0 capsules");
}

TEST(ResultWordsTest, MissingPartsAreNamedInPairs) {
  const ResultSet result = *ParseResultSet(OwnResult(R"(["torso", "arms", "feet"])", kUpright));
  EXPECT_EQ(MissingParts(result, AllParts()), "not fitted: legs, head, hands, feet");
  PartFlags on_body = AllParts();
  for (const body::Part part :
       {body::Part::kLeftHand, body::Part::kRightFoot, body::Part::kHead, body::Part::kRightLeg}) {
    on_body[Index(part)] = false;
  }
  EXPECT_EQ(MissingParts(result, on_body),
            "not fitted: left leg, right hand, left foot     not on the body: right foot");
}

TEST(ResultWordsTest, NothingIsMissingWhereNothingIsSaid) {
  const ResultSet result = *ParseResultSet(R"({"spheres": [[0, 0, 0, 1]]})");
  EXPECT_EQ(MissingParts(result, AllParts()), "");
  EXPECT_TRUE(PartLegend(result).empty());
}

TEST(ResultWordsTest, SpheresTellThePartsOfAnotherProgramsResult) {
  const ResultSet result = *ParseResultSet(
      R"({"spheres": [[0, 0, 0, 1], [0, 1, 0, 1]], "sphere_parts": ["head", "torso"]})");
  EXPECT_EQ(MissingParts(result, AllParts()), "not fitted: arms, legs, hands, feet");
}

TEST(ResultWordsTest, LegendHasThePartsThatAreThereInTheirColours) {
  const auto legend = PartLegend(*ParseResultSet(OwnResult(R"(["torso"])", kUpright)));
  ASSERT_THAT(legend, ElementsAre(Field(&LegendEntry::words, "torso"),
                                  Field(&LegendEntry::words, "left arm")));
  EXPECT_EQ(legend[0].color, PartColor("torso", 0.5));
  EXPECT_EQ(legend[1].color, PartColor("left_arm", 0.5));
}

TEST(ResultWordsTest, PolygonLegendHasThePartsThatAreCut) {
  ResultSet result = *ParseResultSet(OwnResult(R"(["torso"])", kUpright));
  result.polygons.push_back({"left_knee", "left_leg", {}, {}, 0.0});
  const auto legend = PolygonLegend(result);
  ASSERT_EQ(legend.size(), 3u);
  EXPECT_EQ(legend[0].mark, LegendMark::kLine);
  EXPECT_EQ(legend[1].mark, LegendMark::kDashedLine);
  EXPECT_EQ(legend[2].words, "left leg");
}

TEST(ResultWordsTest, TheResultsOwnTurnIsReadAndMustBeOne) {
  const auto turned = ParseResultSet(OwnResult("[]", "[1, 0, 0, 0, 0, 1, 0, -1, 0]"));
  ASSERT_TRUE(turned.ok()) << turned.status();
  ASSERT_TRUE(turned->body_from_caller.has_value());
  EXPECT_EQ(*turned->body_from_caller * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
  for (const char* const wrong :
       {"[2, 0, 0, 0, 2, 0, 0, 0, 2]", "[-1, 0, 0, 0, 1, 0, 0, 0, 1]", "[1, 0]", "null"}) {
    EXPECT_EQ(FieldOf(ParseResultSet(OwnResult("[]", wrong)).status()),
              "body_from_caller.rotation");
  }
}

}  // namespace
}  // namespace capfit::client
