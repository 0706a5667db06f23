// Replays the seeds and the kept findings of the fuzzer of uploads, in every build.
#include <gtest/gtest.h>

#include "tests/core/mesh/corpus.h"
#include "tests/fuzz/upload_targets.h"
#include "tests/support/bodies.h"

namespace capfit::fuzz {
namespace {

TEST(UploadCorpusTest, UploadKeepsItsPromises) {
  const auto files = Corpus("upload");
  EXPECT_GT(files.size(), 10u);
  for (const auto& file : files) {
    const std::string bytes = test_support::ReadFile(file);
    EXPECT_EQ(TryUpload(std::as_bytes(std::span(bytes))), "") << file;
  }
}

}  // namespace
}  // namespace capfit::fuzz
