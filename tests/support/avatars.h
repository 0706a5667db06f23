// The avatars with ground truth that tests run on where they exist.
#ifndef CAPFIT_TESTS_SUPPORT_AVATARS_H_
#define CAPFIT_TESTS_SUPPORT_AVATARS_H_

#include <filesystem>

namespace capfit::test_support {

// The folder of avatars: $CAPFIT_AVATARS, else ../shared/avatars beside the source tree; empty when
// it holds no truth.json.
[[nodiscard]] std::filesystem::path AvatarsFolder();

}  // namespace capfit::test_support

// Skips the current test, loudly, where the avatars are not there.
#define CAPFIT_REQUIRE_AVATARS()                                                          \
  if (capfit::test_support::AvatarsFolder().empty())                                      \
  GTEST_SKIP() << "SKIPPED: no avatars found; set CAPFIT_AVATARS to the folder that has " \
                  "truth.json"

#endif  // CAPFIT_TESTS_SUPPORT_AVATARS_H_
