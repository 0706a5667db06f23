#include "tests/support/avatars.h"

#include <cstdlib>

namespace capfit::test_support {

std::filesystem::path AvatarsFolder() {
  const char* const named = std::getenv("CAPFIT_AVATARS");
  const std::filesystem::path folder =
      named != nullptr ? std::filesystem::path(named)
                       : std::filesystem::path(CAPFIT_SOURCE_DIR) / ".." / "shared" / "avatars";
  return std::filesystem::exists(folder / "truth.json") ? folder : std::filesystem::path();
}

}  // namespace capfit::test_support
