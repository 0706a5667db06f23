#include "core/formats/gltf_clips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/gltf_accessor.h"
#include "core/formats/gltf_file.h"
#include "core/formats/gltf_json.h"
#include "core/formats/gltf_skins.h"

namespace capfit::formats {

using nlohmann::json;

namespace {

constexpr std::size_t kMostClips = 10'000;
// Values of all channels: an hour of sixty joints at 30 a second are 20 million. Channels may share
// what the file has once, so few bytes could ask for much.
constexpr std::size_t kMostValues = 4'000'000;

FilePlace AtChannel(std::size_t clip, std::size_t channel) {
  return AtRow(absl::StrCat("animation ", clip, " channel"), channel);
}

}  // namespace

class GltfClipsReader {
 public:
  explicit GltfClipsReader(GltfFile& file) : file_(file) {}

  absl::StatusOr<GltfClips> Run() {
    CAPFIT_ASSIGN_OR_RETURN(clips_.nodes_, ReadGltfNodes(file_.description()));
    for (const json& node : ArrayAt(file_.description(), "nodes")) {
      clips_.places_.push_back(PlaceOf(node));
    }
    CAPFIT_ASSIGN_OR_RETURN(const GltfSkeleton skeleton, ReadGltfSkeleton(file_, clips_.nodes_));
    for (const NamedJoint& joint : skeleton.joints) {
      clips_.joint_nodes_.push_back(static_cast<std::size_t>(joint.node));
    }
    const json& animations = ArrayAt(file_.description(), "animations");
    if (animations.size() > kMostClips) {
      return FileTooLarge({}, animations.size(), "animations", kMostClips);
    }
    for (std::size_t clip = 0; clip < animations.size(); ++clip) {
      CAPFIT_RETURN_IF_ERROR(AddClip(animations[clip], clip));
    }
    return std::move(clips_);
  }

 private:
  using Path = GltfClips::Path;
  using Interpolation = GltfClips::Interpolation;

  absl::Status AddClip(const json& animation, std::size_t clip) {
    clips_.clips_.push_back({NameAt(animation, "name"), 0.0});
    clips_.channels_.emplace_back();
    const json& channels = ArrayAt(animation, "channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const json& target = ValueAt(channels[c], "target");
      const std::optional<std::size_t> node = IndexAt(target, "node", clips_.places_.size());
      const std::optional<Path> path = PathOf(NameAt(target, "path"));
      // Without a node of its own it is what an extension says; others move no node.
      if (!ValueAt(target, "node").is_null() && !node) {
        return BadIndexAt(AtChannel(clip, c), target, "node", clips_.places_.size());
      }
      if (!node || !path) continue;
      CAPFIT_ASSIGN_OR_RETURN(
          GltfClips::Channel channel,
          ReadChannel(animation, channels[c], {*node, *path, {}, {}, {}}, AtChannel(clip, c)));
      clips_.clips_.back().length_s =
          std::max(clips_.clips_.back().length_s, channel.times_s.back());
      clips_.channels_.back().push_back(std::move(channel));
    }
    return absl::OkStatus();
  }

  static std::optional<Path> PathOf(const std::string& word) {
    if (word == "translation") return Path::kTranslation;
    if (word == "rotation") return Path::kRotation;
    if (word == "scale") return Path::kScale;
    return std::nullopt;
  }

  static std::optional<Interpolation> InterpolationOf(const json& sampler) {
    if (ValueAt(sampler, "interpolation").is_null()) return Interpolation::kLinear;
    const std::string word = NameAt(sampler, "interpolation");
    if (word == "LINEAR") return Interpolation::kLinear;
    if (word == "STEP") return Interpolation::kStep;
    if (word == "CUBICSPLINE") return Interpolation::kCubicSpline;
    return std::nullopt;
  }

  absl::StatusOr<GltfClips::Channel> ReadChannel(const json& animation, const json& json_channel,
                                                 GltfClips::Channel channel,
                                                 const FilePlace& place) {
    const json& samplers = ArrayAt(animation, "samplers");
    const std::optional<std::size_t> index = IndexAt(json_channel, "sampler", samplers.size());
    if (!index) return BadIndexAt(place, json_channel, "sampler", samplers.size());
    const json& sampler = samplers[*index];
    const std::optional<Interpolation> interpolation = InterpolationOf(sampler);
    if (!interpolation) {
      return FileError(ErrorReason::kUnsupportedFile, place,
                       "its interpolation is none of STEP, LINEAR, CUBICSPLINE");
    }
    channel.interpolation = *interpolation;
    const bool is_rotation = channel.path == Path::kRotation;
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor times, Open(sampler, "input", "SCALAR", place));
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor values,
                            Open(sampler, "output", is_rotation ? "VEC4" : "VEC3", place));
    CAPFIT_RETURN_IF_ERROR(ReadTimes(times, channel, place));
    CAPFIT_RETURN_IF_ERROR(ReadValues(values, channel, place));
    return channel;
  }

  absl::StatusOr<GltfAccessor> Open(const json& sampler, const char* key, const std::string& type,
                                    const FilePlace& place) {
    const std::size_t accessors = ArrayAt(file_.description(), "accessors").size();
    const std::optional<std::size_t> index = IndexAt(sampler, key, accessors);
    if (!index) return BadIndexAt(place, sampler, key, accessors);
    return GltfAccessor::Create(file_, *index, type);
  }

  absl::Status ReadTimes(const GltfAccessor& times, GltfClips::Channel& channel,
                         const FilePlace& place) {
    if (times.count() == 0) return FileError(ErrorReason::kMissing, place, "it has no keys");
    values_ += times.count();
    if (values_ > kMostValues) return FileTooLarge(place, values_, "keys", kMostValues);
    double before = 0.0;
    for (std::size_t i = 0; i < times.count(); ++i) {
      const double time = times.At(i, 0);
      if (!(time >= before) || !std::isfinite(time)) {
        return FileError(
            ErrorReason::kOutOfOrder, place,
            absl::StrCat("its key ", i, " is at ", time, " s, must not be before ", before, " s"));
      }
      channel.times_s.push_back(time);
      before = time;
    }
    return absl::OkStatus();
  }

  absl::Status ReadValues(const GltfAccessor& values, GltfClips::Channel& channel,
                          const FilePlace& place) {
    const std::size_t per_key = channel.interpolation == Interpolation::kCubicSpline ? 3 : 1;
    const std::size_t count = per_key * channel.times_s.size();
    if (values.count() < count) {
      return FileError(ErrorReason::kCountMismatch, place,
                       absl::StrCat("it has ", values.count(), " values for ",
                                    channel.times_s.size(), " keys, must have ", count),
                       ValueAndLimit(values.count(), count));
    }
    values_ += count;
    if (values_ > kMostValues) return FileTooLarge(place, values_, "keys", kMostValues);
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector4d value = Eigen::Vector4d::Zero();
      for (std::size_t k = 0; k < values.components(); ++k) {
        value[static_cast<Eigen::Index>(k)] = values.At(i, k);
      }
      if (!value.allFinite()) {
        return FileError(ErrorReason::kNotFinite, place,
                         absl::StrCat("its value ", i, " must be finite"));
      }
      channel.values.push_back(value);
    }
    return absl::OkStatus();
  }

  GltfFile& file_;
  GltfClips clips_;
  std::size_t values_ = 0;
};

absl::StatusOr<GltfClips> GltfClips::Read(std::span<const std::byte> bytes) {
  CAPFIT_ASSIGN_OR_RETURN(GltfFile file, GltfFile::Open(bytes, GltfContent::kAnimated));
  return GltfClipsReader(file).Run();
}

namespace {

Eigen::Quaterniond Quaternion(const Eigen::Vector4d& xyzw) {
  Eigen::Quaterniond quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (!(quaternion.norm() > 0.0)) return Eigen::Quaterniond::Identity();
  return quaternion.normalized();
}

// Along the shorter arc.
Eigen::Vector4d Slerp(const Eigen::Vector4d& from, const Eigen::Vector4d& to, double share) {
  return Quaternion(from).slerp(share, Quaternion(to)).coeffs();
}

}  // namespace

Eigen::Vector4d GltfClips::ValueAt(const Channel& channel, double time_s) {
  const bool is_cubic = channel.interpolation == Interpolation::kCubicSpline;
  const std::size_t per_key = is_cubic ? 3 : 1;
  const auto value = [&](std::size_t key) { return channel.values[per_key * key + per_key / 2]; };
  const auto behind = std::upper_bound(channel.times_s.begin(), channel.times_s.end(), time_s);
  if (behind == channel.times_s.begin()) return value(0);
  if (behind == channel.times_s.end()) return value(channel.times_s.size() - 1);
  const auto next = static_cast<std::size_t>(behind - channel.times_s.begin());
  const std::size_t key = next - 1;
  if (channel.interpolation == Interpolation::kStep) return value(key);
  const double length_s = channel.times_s[next] - channel.times_s[key];
  const double t = (time_s - channel.times_s[key]) / length_s;
  if (!is_cubic) {
    if (channel.path == Path::kRotation) return Slerp(value(key), value(next), t);
    return value(key) + t * (value(next) - value(key));
  }
  // Hermite's; tangents are per second.
  const Eigen::Vector4d& leaving = channel.values[3 * key + 2];
  const Eigen::Vector4d& arriving = channel.values[3 * next];
  const double t2 = t * t;
  const double t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * value(key) + (t3 - 2.0 * t2 + t) * length_s * leaving +
         (3.0 * t2 - 2.0 * t3) * value(next) + (t3 - t2) * length_s * arriving;
}

void GltfClips::Move(const Channel& channel, double time_s, GltfNodePlace& place) {
  const Eigen::Vector4d value = ValueAt(channel, time_s);
  place.matrix.reset();  // the format forbids it on nodes that move
  switch (channel.path) {
    case Path::kTranslation:
      place.translation = value.head<3>();
      break;
    case Path::kRotation:
      place.rotation = Quaternion(value);
      break;
    case Path::kScale:
      place.scale = value.head<3>();
      break;
  }
}

std::vector<Placing> GltfClips::JointsAt(std::size_t clip, double time_s) const {
  assert(clip < clips_.size());
  std::vector<GltfNodePlace> places = places_;
  for (const Channel& channel : channels_[clip]) Move(channel, time_s, places[channel.node]);
  std::vector<Eigen::Matrix4d> to_world(places.size());
  for (const std::size_t n : nodes_.order) {
    to_world[n] = places[n].ToParent();
    if (nodes_.parent[n] != GltfNodes::kNone) {
      to_world[n] = (to_world[nodes_.parent[n]] * to_world[n]).eval();
    }
  }
  std::vector<Placing> joints;
  for (const std::size_t n : joint_nodes_) joints.emplace_back(to_world[n].topRows<3>());
  return joints;
}

}  // namespace capfit::formats
