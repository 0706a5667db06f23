// Replays the seeds and the kept findings of the fuzzers, in every build.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/fuzz/mesh_targets.h"
#include "tests/support/bodies.h"

namespace capfit::fuzz {
namespace {

std::vector<std::filesystem::path> Corpus(const std::string& target) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(CAPFIT_FUZZ_CORPUS) / target)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  EXPECT_GT(files.size(), 10u);
  return files;
}

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
