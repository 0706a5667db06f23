// The medial curves of trunk, arms and legs.
#ifndef CAPFIT_CORE_BODY_CHAINS_H_
#define CAPFIT_CORE_BODY_CHAINS_H_

#include <array>
#include <optional>

#include "core/body/body.h"
#include "core/body/shape.h"

namespace capfit::body {

// By Part, the chains only; nothing where the limb or a landmark at its end is missing.
[[nodiscard]] std::array<std::optional<MedialCurve>, kChainCount> BuildChains(
    const Shape& shape, const Landmarks& landmarks);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_CHAINS_H_
