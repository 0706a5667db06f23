// Replays the seeds and the kept findings of the fuzzer of landmarks, in every build.
#include <gtest/gtest.h>

#include "tests/core/mesh/corpus.h"
#include "tests/fuzz/body_targets.h"
#include "tests/support/bodies.h"

namespace capfit::fuzz {
namespace {

TEST(BodyCorpusTest, FindBodyKeepsItsPromises) {
  const auto files = Corpus("find_body");
  EXPECT_GT(files.size(), 10u);
  for (const auto& file : files) {
    const std::string bytes = test_support::ReadFile(file);
    EXPECT_EQ(TryFindBody(std::as_bytes(std::span(bytes))), "") << file;
  }
}

}  // namespace
}  // namespace capfit::fuzz
