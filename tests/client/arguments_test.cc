#include "client/arguments.h"

#include <gtest/gtest.h>

#include "client/word_option.h"

namespace capfit::client {
namespace {

using Words = std::vector<std::string>;

// A command with two files and two lists, one of them of numbers.
class JoinListsTest : public testing::Test {
 protected:
  JoinListsTest() {
    CLI::App* const command = app_.add_subcommand("fit", "");
    command->add_option("BODY", body_);
    command->add_option("RESULT", result_);
    command->add_option("--title", title_);
    AddWordList(*command, "-p,--parts", parts_, {"torso", "arms", "left_leg"}, "");
    command->add_option("--show", show_)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::NonNegativeNumber);
  }
  void Parse(const Words& words) {
    Words joined = JoinLists(app_, words);
    std::reverse(joined.begin(), joined.end());
    app_.parse(joined);
  }

  CLI::App app_;
  std::string body_, result_, title_;
  Words parts_;
  std::vector<int> show_;
};

TEST_F(JoinListsTest, BlanksAndCommasMeanTheSameWhereverTheFilesStand) {
  const Words parts = {"torso", "arms"};
  for (const Words& words :
       std::vector<Words>{{"fit", "--parts", "torso,arms", "b.obj", "r.json"},
                          {"fit", "--parts", "torso", "arms", "b.obj", "r.json"},
                          {"fit", "b.obj", "--parts", "torso,", "arms", "r.json"},
                          {"fit", "b.obj", "r.json", "--parts", "torso", ",", "arms"},
                          {"fit", "-p", "TORSO", "Arms", "b.obj", "--title", "arms", "r.json"},
                          {"fit", "--parts=torso", "arms", "b.obj", "r.json"},
                          {"fit", "--parts", "torso", "--parts", "arms", "b.obj", "r.json"}}) {
    ASSERT_NO_THROW(Parse(words)) << CLI::detail::join(words, " ");
    EXPECT_EQ(parts_, parts) << CLI::detail::join(words, " ");
    EXPECT_EQ(body_, "b.obj");
    EXPECT_EQ(result_, "r.json");
  }
  EXPECT_EQ(title_, "arms") << "the value of another flag is none of the list";
}

TEST_F(JoinListsTest, NumbersAreJoinedToo) {
  Parse({"fit", "--show", "0", "20,", "60", "b.obj"});
  EXPECT_EQ(show_, (std::vector<int>{0, 20, 60}));
  EXPECT_EQ(body_, "b.obj");
}

TEST_F(JoinListsTest, WhatIsNoListStays) {
  EXPECT_EQ(JoinLists(app_, {"fit", "--title", "torso", "arms"}),
            (Words{"fit", "--title", "torso", "arms"}));
  EXPECT_EQ(JoinLists(app_, {"fit", "--", "--parts", "torso", "arms"}),
            (Words{"fit", "--", "--parts", "torso", "arms"}));
  EXPECT_EQ(JoinLists(app_, {"fit", "--parts"}), (Words{"fit", "--parts"}));
  EXPECT_EQ(JoinLists(app_, {"sit", "--parts", "torso", "arms"}),
            (Words{"sit", "--parts", "torso", "arms"}));
  EXPECT_EQ(JoinLists(app_, {}), Words{});
}

TEST_F(JoinListsTest, LeftOverWordsGoOnlyIntoTheList) {
  Parse({"fit", "--parts", "torso", "./arms"});  // a file, because it has a folder
  EXPECT_EQ(body_, "./arms");
  EXPECT_EQ(parts_, Words{"torso"});
}

TEST_F(JoinListsTest, KnownNamesAreKnown) {
  EXPECT_EQ(UnknownName(app_, {"fit", "--parts=torso", "-p", "arms", "--", "--wings"}), "");
  EXPECT_EQ(UnknownName(app_, {"--help"}), "");
  EXPECT_EQ(UnknownName(app_, {}), "");
  EXPECT_EQ(UnknownName(app_, {"fit", "--shwo"}), "fit has no flag --shwo; did you mean --show?");
}

}  // namespace
}  // namespace capfit::client
