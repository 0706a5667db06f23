#include "core/export/file_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "core/export/json_text.h"

namespace capfit::exports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(NumberText, ReadsBackToTheSameBits) {
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  for (int i = 0; i < 1000; ++i) {
    const double number = std::pow(10.0, exponent(rng)) * (i % 2 == 0 ? 1.0 : -1.0);
    EXPECT_EQ(std::strtod(NumberText(number).c_str(), nullptr), number);
    const auto single = static_cast<float>(number);
    EXPECT_EQ(std::strtof(FloatText(single).c_str(), nullptr), single);
  }
}

TEST(NumberText, IsShortAndHasNoNegativeZero) {
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(-0.0), "0");
  EXPECT_EQ(FloatText(2.0F), "2.0");
  EXPECT_EQ(FloatText(-0.0F), "0.0");
  EXPECT_EQ(FloatText(1e20), "1e+20");
  EXPECT_EQ(FloatText(-1e300), "-3.4028235e+38");  // no infinity, which no compiler reads
}

TEST(XmlText, HasNothingThatEndsAnAttribute) {
  EXPECT_EQ(XmlText("a<b>&\"'\n"), "a&lt;b&gt;&amp;&quot;&apos;_");
  EXPECT_EQ(XmlText("\xc3\xa9"), "\xc3\xa9");
  EXPECT_EQ(XmlText("\xff"), "\xef\xbf\xbd");  // no UTF-8
}

TEST(CommentText, CannotEndOrContinueAComment) {
  for (const std::string text : {"*/ int x;", "-->", "a\nb", "back\\", "\xc3\xa9", "a\r", "--"}) {
    const std::string comment = CommentText(text);
    for (const char* end : {"*", "--", "\n", "\r", "\\"}) EXPECT_THAT(comment, Not(HasSubstr(end)));
    EXPECT_EQ(comment.size(), text.size());
  }
}

TEST(CsvText, QuotesWhatMustBe) {
  EXPECT_EQ(CsvText("plain name"), "plain name");
  EXPECT_EQ(CsvText("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvText("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(CsvText("#1"), "\"#1\"");
}

TEST(UniqueNames, LeavesEachNameWhereItIsTheOnlyOne) {
  EXPECT_THAT(UniqueNames({"a", "b"}, "joint"), ElementsAre("a", "b"));
  EXPECT_THAT(UniqueNames({"a", "a", "a_2", "", "a"}, "joint"),
              ElementsAre("a", "a_3", "a_2", "joint_3", "a_4"));
  EXPECT_THAT(UniqueNames({"joint_1", ""}, "joint"), ElementsAre("joint_1", "joint_1_2"));
}

TEST(UniqueNames, ManyOfOneNameAreQuick) {
  const std::vector<std::string> names = UniqueNames(std::vector<std::string>(100000, "b"), "j");
  EXPECT_EQ(names[0], "b");
  EXPECT_EQ(names[99999], "b_100000");
}

TEST(Statement, SaysWhatEveryFileSays) {
  ColliderSet set;
  set.version = "1.2.3";
  set.source = "bo*/dy\n";
  set.profile = capsule::CapsuleProfile::kUniformRadius;
  const Statement statement = StatementOf(set, "capfit-x", UnrealFrame(), "along +Z");
  EXPECT_EQ(StatementLines(statement, "# ", ";"),
            "# format: capfit-x;\n# format_version: 1;\n# capfit: 1.2.3;\n# source: bo_/dy_;\n"
            "# frame: centimetres, +Z up, +Y ahead, left-handed;\n# axis: along +Z;\n"
            "# profile: uniform_radius;\n");
  const nlohmann::ordered_json json = StatementJson(statement);
  EXPECT_EQ(json.at("source"), "bo*/dy\n");
  EXPECT_EQ(json.at("format_version"), kFormatVersion);
}

TEST(JsonText, ReadsBackWhateverTheNames) {
  nlohmann::ordered_json json = {{"name", "\xff\"\\\n"}, {"list", {1.5, "x"}}, {"none", {}}};
  const auto back = nlohmann::json::parse(JsonText(json));
  EXPECT_EQ(back.at("name"), "\xef\xbf\xbd\"\\\n");
  EXPECT_EQ(back.at("list"), (nlohmann::json{1.5, "x"}));
  json["name"] = "\xc3\xa9";
  EXPECT_THAT(JsonText(json), HasSubstr("\\u00e9"));  // ASCII
}

TEST(CStringText, IsReadBackByACompiler) {
  EXPECT_EQ(CStringText("left_arm"), "\"left_arm\"");
  EXPECT_EQ(CStringText("a\"b\\ \n\xc3\xa9 1??/"), R"("a\042b\134 \012\303\251 1\077\077/")");
}

}  // namespace
}  // namespace capfit::exports
