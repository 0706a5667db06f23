// Told by every format whose capsules may not have one sphere inside the other.
#ifndef CAPFIT_CORE_EXPORT_BALL_WARNINGS_H_
#define CAPFIT_CORE_EXPORT_BALL_WARNINGS_H_

#include <string>
#include <vector>

#include "core/base/warning.h"
#include "core/export/solids.h"

namespace capfit::exports {

// INNER_SPHERES: how many capsules are a sphere for `engine`; empty where none is.
[[nodiscard]] std::vector<Warning> BallWarnings(const std::vector<Solid>& solids,
                                                const std::string& engine);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_BALL_WARNINGS_H_
