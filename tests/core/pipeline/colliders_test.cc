#include "core/pipeline/colliders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "core/base/status.h"

namespace capfit::pipeline {
namespace {

using testing::HasSubstr;

// Known before a fit, not after it.
TEST(CheckExports, NamesTheWishThatNeedsTheFittedFile) {
  const std::vector<ExportWish> wishes = {{"unity", {}}, {"vrm", {}}};
  const std::string glb = std::string("glTF\x02\0\0\0", 8) + std::string(40, ' ');
  EXPECT_TRUE(CheckExports(wishes, std::as_bytes(std::span(glb))).ok());
  for (const std::string& original : {std::string(), std::string("v 0 0 0\n"), glb.substr(0, 12)}) {
    const absl::Status refused = CheckExports(wishes, std::as_bytes(std::span(original)));
    EXPECT_EQ(FieldOf(refused), "exports[1].format") << refused;
    EXPECT_THAT(refused.message(), HasSubstr("is vrm, which puts the colliders into the file"));
    EXPECT_TRUE(CheckExports({wishes.data(), 1}, std::as_bytes(std::span(original))).ok());
  }
}

}  // namespace
}  // namespace capfit::pipeline
