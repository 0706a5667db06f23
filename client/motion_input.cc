#include "client/motion_input.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/picture/file_bytes.h"
#include "core/base/status.h"
#include "core/formats/gltf_clips.h"

namespace capfit::client {
namespace {

constexpr double kFrameShare = 1e-6;  // of a frame: a clip of 2 s has 61 frames at 30 a second

absl::StatusOr<pipeline::Motion> FromFile(const std::string& path, std::size_t vertex_count) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string bytes, ReadFileBytes(path));
  const std::size_t frame_bytes = vertex_count * 3 * sizeof(float);
  if (frame_bytes == 0 || bytes.empty() || bytes.size() % frame_bytes != 0) {
    return InvalidField(
        ErrorReason::kCountMismatch, "--cover-motion",
        absl::StrCat("has ", bytes.size(), " bytes, must have a multiple of ", frame_bytes,
                     ": 12 for each of ", vertex_count, " vertices in each frame"));
  }
  pipeline::Motion motion;
  for (std::size_t at = 0; at < bytes.size(); at += frame_bytes) {
    std::vector<Eigen::Vector3f>& frame = motion.frames.emplace_back(vertex_count);
    std::memcpy(frame.data(), bytes.data() + at, frame_bytes);
  }
  return motion;
}

absl::StatusOr<pipeline::Motion> FromClip(const std::string& name, double fps,
                                          std::span<const std::byte> body,
                                          const formats::PolygonSoup& soup) {
  const absl::StatusOr<formats::GltfClips> clips = formats::GltfClips::Read(body);
  if (!clips.ok()) {
    return absl::NotFoundError(
        absl::StrCat("cannot read ", name, ", and BODY has no clip of that name"));
  }
  CAPFIT_ASSIGN_OR_RETURN(const std::size_t clip, clips->Find(name));
  const double count = std::floor(clips->clips()[clip].seconds * fps + kFrameShare) + 1.0;
  if (!(count <= static_cast<double>(pipeline::kMostMotionFrames))) {
    return InvalidField(
        ErrorReason::kTooLarge, "--fps",
        absl::StrCat("makes ", count, " frames, must make at most ", pipeline::kMostMotionFrames));
  }
  pipeline::Motion motion;
  for (std::size_t f = 0; f < static_cast<std::size_t>(count); ++f) {
    motion.joints.push_back(clips->JointsAt(clip, static_cast<double>(f) / fps, soup.joints));
    motion.frames.push_back(pipeline::PoseVertices(soup, motion.joints.back()));
  }
  return motion;
}

}  // namespace

absl::StatusOr<std::shared_ptr<const pipeline::Motion>> ReadMotion(
    const std::string& frames_or_clip, double fps, motion::MotionRadii radii,
    std::span<const std::byte> body, const formats::PolygonSoup& soup) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(frames_or_clip, error);
  CAPFIT_ASSIGN_OR_RETURN(pipeline::Motion motion,
                          is_file ? FromFile(frames_or_clip, soup.positions.size())
                                  : FromClip(frames_or_clip, fps, body, soup));
  motion.radii = radii;
  return std::make_shared<const pipeline::Motion>(std::move(motion));
}

}  // namespace capfit::client
