// Replays the seeds and the kept findings of the fuzzers, in every build.
#include <gtest/gtest.h>

#include "tests/core/mesh/corpus.h"
#include "tests/fuzz/mesh_targets.h"
#include "tests/support/bodies.h"

namespace capfit::fuzz {
namespace {

TEST(FuzzCorpusTest, ReadMeshKeepsItsPromises) {
  for (const auto& file : Corpus("read_mesh")) {
    const std::string bytes = test_support::ReadFile(file);
    EXPECT_EQ(TryReadMesh(std::as_bytes(std::span(bytes))), "") << file;
  }
}

TEST(FuzzCorpusTest, PrepareMeshKeepsItsPromises) {
  for (const auto& file : Corpus("prepare_mesh")) {
    const std::string bytes = test_support::ReadFile(file);
    EXPECT_EQ(TryPrepareMesh(std::as_bytes(std::span(bytes))), "") << file;
  }
}

}  // namespace
}  // namespace capfit::fuzz
