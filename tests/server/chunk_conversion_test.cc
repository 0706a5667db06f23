#include "proto/wire/chunk_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/status.h"
#include "tests/server/fake_fit.h"

namespace capfit::wire {
namespace {

using server::HandMadeResult;

TEST(ChunkConversion, VertexGapsComeBackInPiecesOfAnySize) {
  const std::vector<float> gaps = HandMadeResult(10).vertex_gaps;
  for (const std::size_t max_gaps : {1U, 3U, 9U, 10U, 11U}) {
    std::vector<float> back;
    while (back.size() < gaps.size()) {
      const v1::VertexGapsChunk chunk = GapsToWire(gaps, back.size(), max_gaps);
      EXPECT_LE(static_cast<std::size_t>(chunk.gaps_size()), max_gaps);
      ASSERT_TRUE(AppendGaps(chunk, back).ok());
    }
    ASSERT_EQ(back.size(), gaps.size());
    for (std::size_t v = 0; v < gaps.size(); ++v) {
      if (v == 5) {
        EXPECT_TRUE(std::isnan(back[v]));
      } else {
        EXPECT_EQ(back[v], gaps[v]);
      }
    }
    EXPECT_FALSE(AppendGaps(GapsToWire(gaps, 0, max_gaps), back).ok()) << "one piece too many";
  }
}

TEST(ChunkConversion, PiecesOfGapsThatDoNotFollowAreRefused) {
  const std::vector<float> gaps = HandMadeResult(10).vertex_gaps;
  std::vector<float> back;
  EXPECT_FALSE(AppendGaps(GapsToWire(gaps, 4, 3), back).ok());
  v1::VertexGapsChunk chunk = GapsToWire(gaps, 0, 3);
  chunk.set_total_vertex_count(2);
  EXPECT_EQ(FieldOf(AppendGaps(chunk, back)), "vertex_gaps");
  chunk.set_total_vertex_count(-1);
  EXPECT_EQ(FieldOf(AppendGaps(chunk, back)), "vertex_gaps.total_vertex_count");
  chunk.set_total_vertex_count(std::int64_t{1} << 60);
  EXPECT_EQ(FieldOf(AppendGaps(chunk, back)), "vertex_gaps.total_vertex_count");
  chunk = GapsToWire(gaps, 0, 3);
  chunk.clear_gaps();
  EXPECT_EQ(FieldOf(AppendGaps(chunk, back)), "vertex_gaps");
  EXPECT_TRUE(back.empty());
}

TEST(ChunkConversion, WeightsComeBackInBlocksOfAnySize) {
  const skinning::DenseWeights weights = *HandMadeResult(10).weights;
  for (const std::size_t max_weights : {1U, 3U, 9U, 10U, 11U, 20U, 29U, 30U, 1000U}) {
    skinning::DenseWeights back;
    std::size_t sphere = 0;
    std::size_t vertex = 0;
    for (;;) {
      const WeightBlock block = BlockAt(weights, sphere, vertex, max_weights);
      if (block.sphere_count == 0) break;
      EXPECT_LE(block.sphere_count * block.vertex_count, max_weights);
      ASSERT_TRUE(AppendWeights(WeightsToWire(weights, block), back).ok());
      vertex = block.first_vertex + block.vertex_count;
      if (vertex == weights.vertex_count) {
        sphere += block.sphere_count;
        vertex = 0;
      }
    }
    EXPECT_EQ(back.weights, weights.weights) << max_weights;
    EXPECT_EQ(back.vertex_count, 10U);
  }
}

TEST(ChunkConversion, AMissingOrRepeatedBlockIsNoticed) {
  const skinning::DenseWeights weights = *HandMadeResult(10).weights;
  const v1::SkinningChunk second = WeightsToWire(weights, BlockAt(weights, 1, 0, 10));
  skinning::DenseWeights back;
  EXPECT_FALSE(AppendWeights(second, back).ok());
  ASSERT_TRUE(AppendWeights(WeightsToWire(weights, BlockAt(weights, 0, 0, 10)), back).ok());
  ASSERT_TRUE(AppendWeights(second, back).ok());
  EXPECT_FALSE(AppendWeights(second, back).ok());
}

}  // namespace
}  // namespace capfit::wire
