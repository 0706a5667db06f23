// Any choice of parts fits, as long as one of them is on the body.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {
namespace {

// "head", "arms hands": the groups that are fitted.
struct Groups {
  const char* words;

  [[nodiscard]] body::PartSelection Selection() const {
    const std::string all = words;
    const auto has = [&all](const char* word) { return all.find(word) != std::string::npos; };
    return {has("torso"), has("arms"), has("legs"), has("head"), has("hands"), has("feet")};
  }
  friend void PrintTo(const Groups& groups, std::ostream* os) { *os << groups.words; }
};

const formats::PolygonSoup& SharedMannequin() {
  static const auto* const soup = [] {
    mannequin::MannequinOptions options;
    options.faces = 5000;
    return new formats::PolygonSoup(*mannequin::MakeMannequin(options));
  }();
  return *soup;
}

class PartsAlone : public testing::TestWithParam<std::tuple<Groups, Quality, FitMode>> {};

TEST_P(PartsAlone, AreFitted) {
  const auto& [groups, quality, fit] = GetParam();
  FitOptions options;
  options.max_primitives = 30;
  options.parts = groups.Selection();
  options.quality = quality;
  options.fit = fit;
  NullObserver observer;
  const auto result = Fit(SharedMannequin(), options, ThreadPool(2), observer);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_LE(result->metrics.n_p, 30);
  EXPECT_GT(result->metrics.E_r, 0.0);
  if (fit == FitMode::kEnclose) {
    EXPECT_EQ(result->metrics.vertices_out, 0);
    EXPECT_LE(result->metrics.max_gap_m, 1e-3);
    // Quality paper has one ball for a hand or a foot, which is long and flat.
    EXPECT_LT(result->metrics.E_r, quality == Quality::kPaper ? 10.0 : 5.0);
  } else {
    EXPECT_LT(result->metrics.E_r, 3.0);
  }
  for (int i = 0; i < body::kPartCount; ++i) {
    const auto part = static_cast<body::Part>(i);
    EXPECT_EQ(result->metrics.parts[i].has_value(), options.parts.Includes(part))
        << std::string(body::PartName(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Groups, PartsAlone,
    testing::Combine(testing::Values(Groups{"torso"}, Groups{"arms"}, Groups{"legs"},
                                     Groups{"head"}, Groups{"hands"}, Groups{"feet"},
                                     Groups{"head hands"}, Groups{"hands feet"},
                                     Groups{"torso head"}, Groups{"arms hands"},
                                     Groups{"legs feet"}, Groups{"arms head"}),
                     testing::Values(Quality::kPaper, Quality::kTight),
                     testing::Values(FitMode::kEnclose, FitMode::kBestFit)));

// What lies beside the cut, such as the shoulder of an arm, belongs to no chain's first circles: it
// is reached by moving there, not by a balloon around it (which had E_r of .4 to .7).
TEST(PartsAlone, AreAsTightBesideTheCutAsElsewhere) {
  for (const char* const words : {"torso", "arms"}) {
    for (const Quality quality : {Quality::kPaper, Quality::kBalanced, Quality::kTight}) {
      FitOptions options;
      options.parts = Groups{words}.Selection();
      options.quality = quality;
      NullObserver observer;
      const auto result = Fit(SharedMannequin(), options, ThreadPool(2), observer);
      ASSERT_TRUE(result.ok()) << result.status();
      EXPECT_LT(result->metrics.E_r, 0.37) << words << " " << static_cast<int>(quality);
      EXPECT_EQ(result->metrics.vertices_out, 0);
    }
  }
}

}  // namespace
}  // namespace capfit::pipeline
