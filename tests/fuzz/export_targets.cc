#include "tests/fuzz/export_targets.h"

#include <algorithm>

#include "core/export/gltf_colliders.h"
#include "core/export/vrm_colliders.h"
#include "core/formats/read_mesh.h"

namespace capfit::fuzz {
namespace {

using exports::ColliderSet;
using formats::PolygonSoup;

constexpr std::size_t kMostJoints = 8;

// A capsule on each of the first joints.
ColliderSet SetOn(const PolygonSoup& soup) {
  ColliderSet set;
  set.joints = soup.joints;
  for (std::size_t j = 0; j < std::min(set.joints.size(), kMostJoints); ++j) {
    const auto joint = static_cast<std::int32_t>(j);
    const Eigen::Vector3d& at = set.joints[j].position;
    set.primitives.capsules.push_back(
        {static_cast<int>(set.sphere_count()), static_cast<int>(set.sphere_count()) + 1});
    set.primitives.spheres.push_back({at, 0.1});
    set.primitives.spheres.push_back({at + Eigen::Vector3d(0.1, 0.5, -0.2), 0.12});
    for (const char* end : {"a", "b"}) set.sphere_names.push_back(end + std::to_string(j));
    set.sphere_joints.insert(set.sphere_joints.end(), {joint, joint});
    set.capsule_joints.push_back(joint);
  }
  if (soup.joints.empty()) {
    set.primitives.spheres.push_back({Eigen::Vector3d::Zero(), 0.5});
    set.sphere_names.push_back("one");
  }
  set.primitives.origins.resize(set.sphere_count());
  return set;
}

std::string ReadAgain(const absl::StatusOr<exports::Exported>& exported, const PolygonSoup& soup,
                      bool is_same_mesh) {
  if (!exported.ok()) {
    return exported.status().code() == absl::StatusCode::kInvalidArgument
               ? ""
               : "an error of another code: " + exported.status().ToString();
  }
  const auto again = formats::ReadMesh(std::as_bytes(std::span(exported->files[0].bytes)),
                                       formats::MeshFormat::kGlb);
  if (!again.ok()) return "what was written cannot be read: " + again.status().ToString();
  if (!is_same_mesh) return {};
  if (again->positions != soup.positions) return "vertices moved";
  if (again->face_vertices != soup.face_vertices) return "faces changed";
  return {};
}

}  // namespace

std::string TryWriteBack(std::span<const std::byte> bytes) {
  if (bytes.empty()) return {};
  const std::span<const std::byte> original = bytes.subspan(1);
  const auto soup = formats::ReadMesh(original, formats::MeshFormat::kGlb);
  if (!soup.ok() || formats::FormatFromBytes(original) != formats::MeshFormat::kGlb) return {};
  const ColliderSet set = SetOn(*soup);
  std::string broken = ReadAgain(exports::WriteGltf(set, original), *soup, true);
  if (broken.empty()) {
    broken = ReadAgain(exports::WriteGltf(set, original, {.has_preview = true}), *soup, false);
  }
  if (broken.empty()) broken = ReadAgain(exports::WriteVrm(set, original), *soup, true);
  return broken;
}

}  // namespace capfit::fuzz
