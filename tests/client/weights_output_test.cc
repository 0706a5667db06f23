#include "client/weights_output.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/server/fake_fit.h"
#include "tests/support/scratch.h"

namespace capfit::client {
namespace {

TEST(WeightsOutput, StandBesideTheResult) {
  EXPECT_EQ(WeightsPath("a/result.json"), "a/result.weights.json");
  EXPECT_EQ(WeightsPath("result"), "result.weights.json");
}

TEST(WeightsOutput, ComeBackFromTheResultsNameOrTheirOwn) {
  const test_support::Scratch scratch;
  const std::string result = scratch.Path("result.json");
  const skinning::DenseWeights weights = *server::HandMadeResult(9).weights;
  ASSERT_TRUE(WriteWeights(weights, result).ok());
  for (const std::string& name : {result, WeightsPath(result)}) {
    const auto back = ReadWeights(name);
    ASSERT_TRUE(back.ok()) << back.status();
    EXPECT_EQ(back->weights, weights.weights);
    EXPECT_EQ(back->vertex_count, 9U);
  }
  EXPECT_EQ(ReadWeights(scratch.Path("other.json")).status().code(), absl::StatusCode::kNotFound);
}

TEST(WeightsOutput, AFolderThatIsNotThereIsAFileProblem) {
  EXPECT_EQ(WriteWeights(*server::HandMadeResult(2).weights, "no/such/folder/r.json").code(),
            absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace capfit::client
