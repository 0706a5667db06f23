// The poses of `--cover-motion`: a file of frames, or a clip of the body's own file.
#ifndef CAPFIT_CLIENT_MOTION_INPUT_H_
#define CAPFIT_CLIENT_MOTION_INPUT_H_

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "core/formats/polygon_soup.h"
#include "core/pipeline/motion_frames.h"

namespace capfit::client {

// `frames_or_clip`: a file of little-endian float32, frames x vertices x 3, as `animate --frames`
// takes it; where there is no such file, the name or index of a clip of `body`, `fps` frames a
// second. NOT_FOUND and INVALID_ARGUMENT name what is wrong.
[[nodiscard]] absl::StatusOr<std::shared_ptr<const pipeline::Motion>> ReadMotion(
    const std::string& frames_or_clip, double fps, motion::MotionRadii radii,
    std::span<const std::byte> body, const formats::PolygonSoup& soup);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_MOTION_INPUT_H_
