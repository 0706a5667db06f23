#include "client/carried_frames.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/skinning/stretched_radii.h"

namespace capfit::client {
namespace {

using formats::Placing;

static_assert(std::endian::native == std::endian::little, "frames are little-endian float32");

constexpr std::size_t kMostFrames = 100'000;
constexpr std::size_t kMostNamesTold = 20;
// Behind the clip's end by less than this share of a frame is at its end.
constexpr double kFrameShare = 1e-6;

// Whether a whole frame was read; an error for a part of one.
absl::StatusOr<bool> ReadFrame(std::istream& in, std::size_t frame, std::vector<float>& numbers) {
  const auto bytes = static_cast<std::streamsize>(numbers.size() * sizeof(float));
  in.read(reinterpret_cast<char*>(numbers.data()), bytes);
  if (in.gcount() == bytes) return true;
  if (in.gcount() == 0 && in.eof()) return false;
  return InvalidField(ErrorReason::kMalformedFile, absl::StrCat("frames[", frame, "]"),
                      absl::StrCat("has ", in.gcount(), " bytes, must have ", bytes));
}

absl::Status CheckFinite(const std::vector<float>& numbers, std::size_t per_row,
                         std::size_t frame) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::isfinite(numbers[i])) continue;
    return InvalidField(ErrorReason::kMalformedFile,
                        absl::StrCat("frames[", frame, "][", i / per_row, "]"), "must be finite");
  }
  return absl::OkStatus();
}

// Moves what is carried to one pose after the other.
class Carrier {
 public:
  Carrier(const CarriedSet& set, const ThreadPool& pool) : set_(set), pool_(pool) {
    for (const formats::NamedJoint& joint : set.joints) rest_joints_.push_back(joint.to_mesh);
    if (!set.stretches_radii || IsBones()) return;
    rest_centers_ = CentersOf(set.vertices);
  }

  [[nodiscard]] bool IsBones() const {
    return std::holds_alternative<skinning::BoneWeights>(set_.weights);
  }

  void MoveVertices(std::span<const Eigen::Vector3d> vertices) {
    frames_.centers.push_back(CentersOf(vertices));
    std::vector<double> factors;
    if (set_.stretches_radii) {
      const skinning::CarriedCenters rest = {set_.vertices, rest_centers_};
      const skinning::CarriedCenters now = {vertices, frames_.centers.back()};
      if (const auto* dense = std::get_if<skinning::DenseWeights>(&set_.weights)) {
        factors = skinning::Stretch(*dense, rest, now);
      } else {
        factors = skinning::Stretch(std::get<skinning::SparseWeights>(set_.weights), rest, now);
      }
    }
    AddRadii(factors);
  }

  void MoveJoints(std::span<const Placing> joints) {
    const auto& bones = std::get<skinning::BoneWeights>(set_.weights);
    frames_.centers.push_back(skinning::Apply(bones, joints));
    AddRadii(set_.stretches_radii ? skinning::Stretch(bones, rest_joints_, joints)
                                  : std::vector<double>());
  }

  absl::StatusOr<CarriedFrames> Take() && {
    if (frames_.centers.empty()) {
      return InvalidField(ErrorReason::kMalformedFile, "frames", "is empty");
    }
    return std::move(frames_);
  }

 private:
  [[nodiscard]] std::vector<Eigen::Vector3d> CentersOf(
      std::span<const Eigen::Vector3d> vertices) const {
    if (const auto* dense = std::get_if<skinning::DenseWeights>(&set_.weights)) {
      return skinning::Apply(*dense, vertices, pool_);
    }
    return skinning::Apply(std::get<skinning::SparseWeights>(set_.weights), vertices);
  }

  void AddRadii(const std::vector<double>& factors) {
    frames_.radii.push_back(set_.radii);
    for (std::size_t i = 0; i < factors.size(); ++i) frames_.radii.back()[i] *= factors[i];
  }

  const CarriedSet& set_;
  const ThreadPool& pool_;
  std::vector<Placing> rest_joints_;
  std::vector<Eigen::Vector3d> rest_centers_;
  CarriedFrames frames_;
};

std::string NamesOf(const formats::GltfClips& clips) {
  if (clips.clips().empty()) return "the file has no animations";
  std::string names = "the file has ";
  for (std::size_t i = 0; i < std::min(clips.clips().size(), kMostNamesTold); ++i) {
    absl::StrAppend(&names, i == 0 ? "" : ", ", i, " \"", clips.clips()[i].name, "\"");
  }
  return names + (clips.clips().size() > kMostNamesTold ? ", ..." : "");
}

}  // namespace

absl::StatusOr<CarriedFrames> CarryAlong(const CarriedSet& set, std::istream& in,
                                         const ThreadPool& pool) {
  Carrier carrier(set, pool);
  const std::size_t per_row = carrier.IsBones() ? 12 : 3;
  const std::size_t rows = carrier.IsBones() ? set.joints.size() : set.vertices.size();
  std::vector<float> numbers(per_row * rows);
  std::vector<Eigen::Vector3d> vertices(carrier.IsBones() ? 0 : rows);
  std::vector<Placing> joints(carrier.IsBones() ? rows : 0);
  for (std::size_t frame = 0;; ++frame) {
    CAPFIT_ASSIGN_OR_RETURN(const bool is_whole, ReadFrame(in, frame, numbers));
    if (!is_whole) return std::move(carrier).Take();
    CAPFIT_RETURN_IF_ERROR(CheckFinite(numbers, per_row, frame));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      vertices[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      joints[j] =
          Eigen::Map<const Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(numbers.data() + 12 * j)
              .cast<double>();
    }
    carrier.IsBones() ? carrier.MoveJoints(joints) : carrier.MoveVertices(vertices);
  }
}

absl::StatusOr<CarriedFrames> CarryAlong(const CarriedSet& set, const formats::GltfClips& clips,
                                         std::size_t clip, double fps) {
  const double frames = std::floor(clips.clips()[clip].length_s * fps + kFrameShare) + 1.0;
  if (!(frames <= static_cast<double>(kMostFrames))) {
    return InvalidField(ErrorReason::kTooLarge, "--fps",
                        absl::StrCat("makes ", frames, " frames of ", clips.clips()[clip].length_s,
                                     " s, must make at most ", kMostFrames));
  }
  const ThreadPool pool(1);
  Carrier carrier(set, pool);
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(frames); ++frame) {
    const std::vector<Placing> joints = clips.JointsAt(clip, static_cast<double>(frame) / fps);
    if (joints.size() != set.joints.size()) {
      return InvalidField(
          ErrorReason::kContradictsBody, "BODY",
          absl::StrCat("has ", joints.size(), " joints, RESULT has ", set.joints.size()));
    }
    carrier.MoveJoints(joints);
  }
  return std::move(carrier).Take();
}

absl::StatusOr<std::size_t> FindClip(const formats::GltfClips& clips, const std::string& name) {
  for (std::size_t i = 0; i < clips.clips().size(); ++i) {
    if (clips.clips()[i].name == name) return i;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error == std::errc() && end == name.data() + name.size() && index < clips.clips().size()) {
    return index;
  }
  return InvalidField(ErrorReason::kUnknownValue, "--clip",
                      absl::StrCat("is \"", name.substr(0, 40), "\", but ", NamesOf(clips)));
}

}  // namespace capfit::client
