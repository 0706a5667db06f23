// The real bodies that tests run on where they exist, and shapes made on the spot.
#ifndef CAPFIT_TESTS_SUPPORT_BODIES_H_
#define CAPFIT_TESTS_SUPPORT_BODIES_H_

#include <filesystem>
#include <string>
#include <vector>

namespace capfit::test_support {

// The folder of real bodies: $CAPFIT_BODIES, else ../shared/bodies beside the source tree; empty
// when there is none.
[[nodiscard]] std::filesystem::path BodiesFolder();

// All .obj files directly in the folder, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> BodyFiles();

// The bytes of a file; fails the test when it cannot be read.
[[nodiscard]] std::string ReadFile(const std::filesystem::path& path);

}  // namespace capfit::test_support

// Skips the current test, loudly, where the real bodies are not there.
#define CAPFIT_REQUIRE_BODIES()                                                              \
  if (capfit::test_support::BodiesFolder().empty())                                          \
  GTEST_SKIP() << "SKIPPED: no real bodies found; set CAPFIT_BODIES to the folder that has " \
                  "female_average_rest.obj"

#endif  // CAPFIT_TESTS_SUPPORT_BODIES_H_
