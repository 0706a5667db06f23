#include "server/response_sequence.h"

#include <gtest/gtest.h>

#include "tests/server/fake_fit.h"

namespace capfit::server {
namespace {

using Part = v1::ApproximateBodyResponse::PartCase;

std::vector<Part> PartsOf(ResponseSequence sequence) {
  std::vector<Part> parts;
  v1::ApproximateBodyResponse response;
  while (sequence.Next(response)) parts.push_back(response.part_case());
  EXPECT_FALSE(sequence.Next(response)) << "the end stays the end";
  return parts;
}

TEST(ResponseSequence, PartsComeInTheOrderOfTheContract) {
  EXPECT_EQ(
      PartsOf(ResponseSequence(HandMadeResult(4), "id")),
      (std::vector<Part>{Part::kWarning, Part::kLandmarks, Part::kFeaturePolygon, Part::kPrimitives,
                         Part::kSkinning, Part::kVertexGaps, Part::kSummary}));
}

TEST(ResponseSequence, PartsThatAreNotThereAreLeftOut) {
  pipeline::FitResult result;
  EXPECT_EQ(PartsOf(ResponseSequence(result, "")),
            (std::vector<Part>{Part::kLandmarks, Part::kPrimitives, Part::kSummary}));
}

TEST(ResponseSequence, LongRowsAreCutAndNoMessageReachesOneMebibyte) {
  constexpr std::size_t kVertices = 500'000;  // 2 MB a row
  ResponseSequence sequence(HandMadeResult(kVertices), "");
  std::size_t weights = 0;
  std::size_t gaps = 0;
  v1::ApproximateBodyResponse response;
  while (sequence.Next(response)) {
    EXPECT_LT(response.ByteSizeLong(), 1024U * 1024U);
    weights += static_cast<std::size_t>(response.skinning().dense().weights_size());
    gaps += static_cast<std::size_t>(response.vertex_gaps().gaps_size());
  }
  EXPECT_EQ(weights, 3 * kVertices);
  EXPECT_EQ(gaps, kVertices);
}

}  // namespace
}  // namespace capfit::server
