// Files that come back with colliders read as the same mesh: the corpus of the readers, whole and
// damaged.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/mesh/corpus.h"
#include "tests/fuzz/export_targets.h"
#include "tests/support/bodies.h"

namespace capfit::fuzz {
namespace {

std::span<const std::byte> BytesOf(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TEST(WriteBack, TheCorpusKeepsItsPromises) {
  for (const auto& file : Corpus("read_mesh")) {
    const std::string bytes = test_support::ReadFile(file);
    EXPECT_EQ(TryWriteBack(BytesOf(bytes)), "") << file;
  }
}

TEST(WriteBack, DamagedFilesKeepItToo) {
  Random random(11);
  for (const auto& file : Corpus("read_mesh")) {
    if (file.filename().string().substr(0, 2) != "gl") continue;
    const std::string bytes = test_support::ReadFile(file);
    for (int round = 0; round < 300; ++round) {
      std::string damaged = bytes;
      for (int k = 0; k < 2; ++k) {
        damaged[random.NextBelow(damaged.size())] = static_cast<char>(random.NextBelow(128));
      }
      ASSERT_EQ(TryWriteBack(BytesOf(damaged)), "") << file << " round " << round;
    }
  }
}

}  // namespace
}  // namespace capfit::fuzz
