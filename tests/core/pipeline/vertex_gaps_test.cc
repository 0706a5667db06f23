#include <gtest/gtest.h>

#include <cmath>

#include "core/pipeline/to_caller_frame.h"

namespace capfit::pipeline {
namespace {

TEST(VertexGaps, AreTheCallersVerticesInTheCallersUnit) {
  // A tetrahedron; the caller's vertices 1 and 5 were welded, 2 is used by no face.
  const mesh::BodyMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}, {3, 1, -1, 0, 2, 1});
  geometry::Similarity caller_from_body;
  caller_from_body.scale = 100.0;  // centimetres
  const std::vector<double> gaps_m = {0.5, -0.25, 0.0, std::nan("")};
  const std::vector<float> gaps = VertexGaps(mesh.vertex_of_source(), gaps_m, caller_from_body);
  ASSERT_EQ(gaps.size(), 6U);
  EXPECT_TRUE(std::isnan(gaps[0])) << "of a part that was not selected";
  EXPECT_EQ(gaps[1], -25.0F);
  EXPECT_TRUE(std::isnan(gaps[2])) << "no face uses it";
  EXPECT_EQ(gaps[3], 50.0F);
  EXPECT_EQ(gaps[4], 0.0F);
  EXPECT_EQ(gaps[5], gaps[1]);
}

}  // namespace
}  // namespace capfit::pipeline
