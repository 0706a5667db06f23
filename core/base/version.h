// The version of the program.
#ifndef CAPFIT_CORE_BASE_VERSION_H_
#define CAPFIT_CORE_BASE_VERSION_H_

#include <string_view>

namespace capfit {

// "0.1.0": semantic versioning, as in the changelog.
[[nodiscard]] std::string_view Version();

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_VERSION_H_
