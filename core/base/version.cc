#include "core/base/version.h"

namespace capfit {

std::string_view Version() { return CAPFIT_VERSION; }

}  // namespace capfit
