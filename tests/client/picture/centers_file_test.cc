#include "client/picture/centers_file.h"

#include <gtest/gtest.h>

#include "client/picture/file_bytes.h"
#include "core/base/status.h"
#include "tests/support/scratch.h"

namespace capfit::client {
namespace {

class CentersFileTest : public testing::Test {
 protected:
  [[nodiscard]] std::string Path(const std::string& name) const { return scratch_.Path(name); }
  [[nodiscard]] absl::Status Refused(const std::string& text) const {
    EXPECT_TRUE(WriteFileBytes(Path("c.json"), text).ok());
    return ReadCenters(Path("c.json")).status();
  }

  const test_support::Scratch scratch_;
};

TEST_F(CentersFileTest, BothFormsReadTheSame) {
  const std::vector<std::vector<Eigen::Vector3d>> frames = {{{1, 2, 3}, {0.1, -1e-9, 4}},
                                                            {{5, 6, 7}, {8, 9, 1.0 / 3.0}}};
  for (const char* const name : {"c.f32", "c.JSON"}) {
    ASSERT_TRUE(WriteFileBytes(Path(name), FormatCenters(frames, name)).ok());
    const auto bytes = ReadCenters(Path(name));
    ASSERT_TRUE(bytes.ok()) << bytes.status();
    EXPECT_EQ(*bytes, FormatCenters(frames, "-")) << name;
  }
  EXPECT_EQ(FormatCenters(frames, "-").size(), 2U * 2U * 12U);
  EXPECT_EQ(FormatCenters(frames, "-").substr(0, 4), std::string("\0\0\x80\x3f", 4));
}

TEST_F(CentersFileTest, RadiiInBothFormsReadTheSame) {
  const std::vector<std::vector<double>> frames = {{0.5, 1.0 / 3.0}, {2.0, 3.0}};
  for (const char* const name : {"r.f32", "r.json"}) {
    ASSERT_TRUE(WriteFileBytes(Path(name), FormatRadii(frames, name)).ok());
    const auto bytes = ReadRadii(Path(name));
    ASSERT_TRUE(bytes.ok()) << bytes.status();
    EXPECT_EQ(*bytes, FormatRadii(frames, "-")) << name;
  }
  ASSERT_TRUE(WriteFileBytes(Path("bad.json"), R"({"frames": [[1, "2"]]})").ok());
  EXPECT_EQ(FieldOf(ReadRadii(Path("bad.json")).status()), "radii[0][1]");
}

TEST_F(CentersFileTest, MistakesAreNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {"{", "centers"},
      {R"({"centers": []})", "centers"},
      {R"({"frames": [7]})", "centers[0]"},
      {R"({"frames": [[[1, 2, 3]], []]})", "centers[1]"},
      {R"({"frames": [[[1, 2, 3], [1, 2]]]})", "centers[0][1]"},
      {R"({"frames": [[[1, 2, null]]]})", "centers[0][0]"},
  };
  for (const auto& [text, field] : cases) EXPECT_EQ(FieldOf(Refused(text)), field) << text;
  EXPECT_EQ(ReadCenters(Path("none.json")).status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace capfit::client
