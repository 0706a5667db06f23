#include "tests/support/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace capfit::test_support {

std::filesystem::path BodiesFolder() {
  const char* const named = std::getenv("CAPFIT_BODIES");
  const std::filesystem::path folder =
      named != nullptr ? std::filesystem::path(named)
                       : std::filesystem::path(CAPFIT_SOURCE_DIR) / ".." / "shared" / "bodies";
  return std::filesystem::exists(folder / "female_average_rest.obj") ? folder
                                                                     : std::filesystem::path();
}

std::vector<std::filesystem::path> BodyFiles() {
  std::vector<std::filesystem::path> files;
  if (BodiesFolder().empty()) return files;
  for (const auto& entry : std::filesystem::directory_iterator(BodiesFolder())) {
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in.good()) << "cannot read " << path;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace capfit::test_support
