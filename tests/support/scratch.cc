#include "tests/support/scratch.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace capfit::test_support {

Scratch::Scratch() : folder_(testing::TempDir() + "capfit_XXXXXX") {
  if (mkdtemp(folder_.data()) == nullptr) {
    throw std::filesystem::filesystem_error("no folder for a test", folder_,
                                            std::error_code(errno, std::generic_category()));
  }
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace capfit::test_support
