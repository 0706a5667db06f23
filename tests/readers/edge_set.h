// A made-up set that has what fitted bodies seldom have.
#ifndef CAPFIT_TESTS_READERS_EDGE_SET_H_
#define CAPFIT_TESTS_READERS_EDGE_SET_H_

#include "core/export/collider_set.h"

namespace capfit::readers {

// In centimetres, Z up: a lone sphere; a capsule of one radius, one along each axis and against it,
// a steep one, one with a sphere inside the other; joints that are turned, that are scaled by 0.01,
// with names that end strings, comments and tags of any language, and two of the same name.
[[nodiscard]] exports::ColliderSet EdgeSet();

}  // namespace capfit::readers

#endif  // CAPFIT_TESTS_READERS_EDGE_SET_H_
