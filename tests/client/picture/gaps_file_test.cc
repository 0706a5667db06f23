#include "client/picture/gaps_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "client/picture/file_bytes.h"
#include "core/base/status.h"
#include "tests/support/scratch.h"

namespace capfit::client {
namespace {

class GapsFileTest : public testing::Test {
 protected:
  [[nodiscard]] std::string Path(const std::string& name) const { return scratch_.Path(name); }

  const test_support::Scratch scratch_;
};

TEST_F(GapsFileTest, ComesBack) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(WriteVertexGaps(std::vector<float>{0.5F, nan, -1e-30F}, 0.01, Path("r.json")).ok());
  EXPECT_EQ(GapsPath(Path("r.json")), Path("r.gaps.json"));
  const auto back = ReadVertexGaps(Path("r.gaps.json"));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->metres_per_unit, 0.01);
  ASSERT_EQ(back->gaps.size(), 3U);
  EXPECT_EQ(back->gaps[0], 0.5F);
  EXPECT_TRUE(std::isnan(back->gaps[1]));
  EXPECT_EQ(back->gaps[2], -1e-30F);
}

TEST_F(GapsFileTest, BytesAreLittleEndian) {
  ASSERT_TRUE(WriteVertexGaps(std::vector<float>{1.0F}, 1.0, Path("r.json")).ok());
  EXPECT_EQ(*ReadFileBytes(Path("r.gaps.f32")), std::string("\0\0\x80\x3f", 4));
}

TEST_F(GapsFileTest, WrongFilesAreRefusedByName) {
  ASSERT_TRUE(WriteVertexGaps(std::vector<float>(5), 1.0, Path("r.json")).ok());
  ASSERT_TRUE(WriteFileBytes(Path("r.gaps.f32"), std::string(16, 'x')).ok());
  EXPECT_EQ(FieldOf(ReadVertexGaps(Path("r.gaps.json")).status()), "data");
  ASSERT_TRUE(WriteFileBytes(Path("a.json"), R"({"format": "other"})").ok());
  EXPECT_EQ(FieldOf(ReadVertexGaps(Path("a.json")).status()), "format");
  ASSERT_TRUE(WriteFileBytes(Path("b.json"), "{").ok());
  EXPECT_EQ(FieldOf(ReadVertexGaps(Path("b.json")).status()), "header");
  EXPECT_EQ(ReadVertexGaps(Path("none.json")).status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace capfit::client
