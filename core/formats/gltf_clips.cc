#include "core/formats/gltf_clips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_accessor.h"
#include "core/formats/gltf_file.h"
#include "core/formats/gltf_json.h"

namespace capfit::formats {
namespace {

using nlohmann::json;
using Path = GltfChannel::Path;
using Interpolation = GltfChannel::Interpolation;

constexpr std::size_t kMostKeys = 2'000'000;
constexpr std::size_t kMostNamed = 8;  // clips in an error

std::optional<Path> PathAt(const json& target) {
  const std::string word = NameAt(target, "path");
  if (word == "translation") return Path::kTranslation;
  if (word == "rotation") return Path::kRotation;
  if (word == "scale") return Path::kScale;
  return std::nullopt;  // weights of morph targets, and what extensions move
}

std::optional<Interpolation> InterpolationAt(const json& sampler) {
  const std::string word = NameAt(sampler, "interpolation");
  if (word.empty() || word == "LINEAR") return Interpolation::kLinear;
  if (word == "STEP") return Interpolation::kStep;
  if (word == "CUBICSPLINE") return Interpolation::kCubicSpline;
  return std::nullopt;
}

class ClipReader {
 public:
  ClipReader(GltfFile& file, std::size_t node_count) : file_(file), node_count_(node_count) {}

  absl::StatusOr<std::vector<GltfClip>> Run() {
    std::vector<GltfClip> clips;
    const json animations = ArrayAt(file_.description(), "animations");
    for (const json& animation : animations) {
      CAPFIT_ASSIGN_OR_RETURN(GltfClip clip,
                              ReadClip(animation, absl::StrCat("animation ", clips.size())));
      clips.push_back(std::move(clip));
    }
    return clips;
  }

 private:
  absl::StatusOr<GltfClip> ReadClip(const json& animation, const std::string& what) {
    GltfClip clip;
    clip.name = NameAt(animation, "name");
    const json& samplers = ArrayAt(animation, "samplers");
    const json& channels = ArrayAt(animation, "channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const FilePlace place = AtElement(absl::StrCat(what, " channel ", c));
      const json& target = ValueAt(channels[c], "target");
      const std::optional<Path> path = PathAt(target);
      const std::optional<std::size_t> node = IndexAt(target, "node", node_count_);
      if (!path || !node) continue;
      const std::optional<std::size_t> sampler = IndexAt(channels[c], "sampler", samplers.size());
      if (!sampler) return BadIndexAt(place, channels[c], "sampler", samplers.size());
      GltfChannel channel;
      channel.node = *node;
      channel.path = *path;
      CAPFIT_RETURN_IF_ERROR(ReadSampler(samplers[*sampler], place, channel));
      if (channel.seconds.empty()) continue;
      clip.seconds = std::max(clip.seconds, channel.seconds.back());
      clip.channels.push_back(std::move(channel));
    }
    return clip;
  }

  absl::Status ReadSampler(const json& sampler, const FilePlace& place, GltfChannel& channel) {
    const std::optional<Interpolation> interpolation = InterpolationAt(sampler);
    if (!interpolation) {
      return FileError(ErrorReason::kUnsupportedFile, place,
                       "its interpolation is none of LINEAR, STEP, CUBICSPLINE");
    }
    channel.interpolation = *interpolation;
    const bool is_turn = channel.path == Path::kRotation;
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor times,
                            AccessorAt(sampler, "input", "SCALAR", place));
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor values,
                            AccessorAt(sampler, "output", is_turn ? "VEC4" : "VEC3", place));
    const std::size_t per_key = *interpolation == Interpolation::kCubicSpline ? 3 : 1;
    if (values.count() != per_key * times.count()) {
      return FileError(ErrorReason::kCountMismatch, place,
                       absl::StrCat("it has ", times.count(), " keys and ", values.count(),
                                    " values, must have ", per_key, " for each key"));
    }
    keys_ += times.count();
    if (keys_ > kMostKeys) return FileTooLarge(place, keys_, "animation keys", kMostKeys);
    CAPFIT_RETURN_IF_ERROR(ReadTimes(times, place, channel.seconds));
    return ReadValues(values, place, channel.values);
  }

  absl::StatusOr<GltfAccessor> AccessorAt(const json& sampler, const char* key, const char* type,
                                          const FilePlace& place) {
    const std::size_t count = ArrayAt(file_.description(), "accessors").size();
    const std::optional<std::size_t> index = IndexAt(sampler, key, count);
    if (!index) return BadIndexAt(place, sampler, key, count);
    return GltfAccessor::Create(file_, *index, type);
  }

  static absl::Status ReadTimes(const GltfAccessor& times, const FilePlace& place,
                                std::vector<double>& seconds) {
    for (std::size_t k = 0; k < times.count(); ++k) {
      const double at = times.At(k, 0);
      if (!std::isfinite(at) || (k > 0 && at < seconds.back())) {
        return FileError(ErrorReason::kMalformedFile, place,
                         absl::StrCat("its key ", k, " is at ", at, " s, must not come before ",
                                      k > 0 ? seconds.back() : 0.0, " s"));
      }
      seconds.push_back(at);
    }
    return absl::OkStatus();
  }

  static absl::Status ReadValues(const GltfAccessor& values, const FilePlace& place,
                                 std::vector<Eigen::Vector4d>& numbers) {
    for (std::size_t k = 0; k < values.count(); ++k) {
      Eigen::Vector4d& number = numbers.emplace_back(Eigen::Vector4d::Zero());
      for (std::size_t c = 0; c < values.components(); ++c) {
        number[static_cast<Eigen::Index>(c)] = values.At(k, c);
      }
      if (!number.allFinite()) {
        return FileError(ErrorReason::kNotFinite, place,
                         absl::StrCat("its value ", k, " must be finite"));
      }
    }
    return absl::OkStatus();
  }

  GltfFile& file_;
  std::size_t node_count_;
  std::size_t keys_ = 0;
};

Eigen::Quaterniond TurnOf(const Eigen::Vector4d& xyzw) {
  const double norm = xyzw.norm();
  if (!(norm > 0.0)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::Vector4d(xyzw / norm));  // Eigen keeps x, y, z, w too
}

// The cubic of glTF: values at both ends, tangents per second.
Eigen::Vector4d Spline(const GltfChannel& channel, std::size_t key, double share, double length) {
  const auto at = [&](std::size_t k, std::size_t part) { return channel.values[3 * k + part]; };
  const double t = share;
  const double t2 = t * t;
  const double t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * at(key, 1) + length * (t3 - 2 * t2 + t) * at(key, 2) +
         (3 * t2 - 2 * t3) * at(key + 1, 1) + length * (t3 - t2) * at(key + 1, 0);
}

Eigen::Vector4d SampleAt(const GltfChannel& channel, double seconds) {
  const bool is_cubic = channel.interpolation == Interpolation::kCubicSpline;
  const auto at_key = [&](std::size_t k) { return channel.values[is_cubic ? 3 * k + 1 : k]; };
  const auto next = std::upper_bound(channel.seconds.begin(), channel.seconds.end(), seconds);
  if (next == channel.seconds.begin()) return at_key(0);
  const auto key = static_cast<std::size_t>(next - channel.seconds.begin()) - 1;
  if (next == channel.seconds.end() || channel.interpolation == Interpolation::kStep) {
    return at_key(key);
  }
  const double length = channel.seconds[key + 1] - channel.seconds[key];
  const double share = (seconds - channel.seconds[key]) / length;
  if (is_cubic) return Spline(channel, key, share, length);
  if (channel.path != Path::kRotation) return (1.0 - share) * at_key(key) + share * at_key(key + 1);
  return TurnOf(at_key(key)).slerp(share, TurnOf(at_key(key + 1))).coeffs();
}

void Move(const GltfChannel& channel, double seconds, NodePose& pose) {
  const Eigen::Vector4d value = SampleAt(channel, seconds);
  switch (channel.path) {
    case Path::kTranslation:
      pose.translation = value.head<3>();
      break;
    case Path::kRotation:
      pose.rotation = TurnOf(value);
      break;
    case Path::kScale:
      pose.scale = value.head<3>();
      break;
  }
}

}  // namespace

absl::StatusOr<GltfClips> GltfClips::Read(std::span<const std::byte> bytes) {
  CAPFIT_ASSIGN_OR_RETURN(GltfFile file, GltfFile::Open(bytes, GltfContent::kAnimations));
  GltfClips clips;
  CAPFIT_ASSIGN_OR_RETURN(clips.nodes_, ReadGltfNodes(file.description()));
  for (const json& node : ArrayAt(file.description(), "nodes")) {
    clips.poses_.push_back(PoseOf(node));
  }
  CAPFIT_ASSIGN_OR_RETURN(clips.clips_, ClipReader(file, clips.poses_.size()).Run());
  return clips;
}

absl::StatusOr<std::size_t> GltfClips::Find(const std::string& name_or_index) const {
  for (std::size_t c = 0; c < clips_.size(); ++c) {
    if (clips_[c].name == name_or_index) return c;
  }
  std::uint32_t index = 0;
  if (absl::SimpleAtoi(name_or_index, &index) && index < clips_.size()) return index;
  std::string known = clips_.empty() ? "the file has no animations" : "must be one of ";
  for (std::size_t c = 0; c < std::min(kMostNamed, clips_.size()); ++c) {
    absl::StrAppend(&known, c == 0 ? "" : ", ", c, " (", Printable(clips_[c].name), ")");
  }
  return InvalidField(ErrorReason::kUnknownValue, "clip",
                      absl::StrCat("is \"", Printable(name_or_index), "\"; ", known));
}

std::vector<Placing> GltfClips::JointsAt(std::size_t clip, double seconds,
                                         std::span<const NamedJoint> joints) const {
  std::vector<NodePose> poses = poses_;
  for (const GltfChannel& channel : clips_[clip].channels)
    Move(channel, seconds, poses[channel.node]);
  std::vector<Eigen::Matrix4d> to_world(poses.size());
  for (const std::size_t node : nodes_.order) {
    const std::size_t parent = nodes_.parent[node];
    to_world[node] = poses[node].ToParent();
    if (parent != GltfNodes::kNone) to_world[node] = (to_world[parent] * to_world[node]).eval();
  }
  std::vector<Placing> placings;
  placings.reserve(joints.size());
  for (const NamedJoint& joint : joints) {
    const bool has_node = joint.node >= 0 && std::cmp_less(joint.node, poses.size());
    placings.push_back(has_node ? Placing(to_world[joint.node].topRows<3>()) : joint.to_mesh);
  }
  return placings;
}

}  // namespace capfit::formats
