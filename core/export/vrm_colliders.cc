#include "core/export/vrm_colliders.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/gltf_document.h"
#include "core/export/gltf_extras.h"
#include "core/export/joint_nodes.h"
#include "core/export/solids.h"
#include "core/export/sphere_chain.h"
#include "core/export/uniform_pieces.h"
#include "core/export/vrm_springs.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_json.h"

namespace capfit::exports {
namespace {

using nlohmann::json;

constexpr double kLeastOvershootM = 0.001;
constexpr double kLargestOvershootM = 0.1;
// An avatar has some hundred springs with some five hundred joints; each is held against each
// collider, and has a list of its own at worst.
constexpr std::size_t kMostSprings = 1024;
constexpr std::size_t kMostSpringPoints = 5000;

constexpr const char* kSpringBone = "VRMC_springBone";

// The object or list at `key`, made where there is none or something else.
json& ObjectIn(json& owner, const char* key) {
  json& value = owner[key];
  if (!value.is_object()) value = json::object();
  return value;
}
json& ListIn(json& owner, const char* key) {
  json& value = owner[key];
  if (!value.is_array()) value = json::array();
  return value;
}

json NumbersIn(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Shapes that become one collider of VRM 1.0 or one group of VRM 0, below one node.
struct VrmCollider {
  std::string name;
  std::size_t node = 0;
  std::vector<UniformPiece> pieces;             // in the scene
  std::vector<geometry::TaperedCapsule> hulls;  // the same

  void Add(const UniformPiece& piece) {
    pieces.push_back(piece);
    hulls.push_back(geometry::TaperedCapsule({piece.a, piece.radius_m}, {piece.b, piece.radius_m}));
  }
};

bool Touches(const std::vector<SpringPoint>& points, const VrmCollider& collider) {
  return std::any_of(points.begin(), points.end(), [&](const SpringPoint& point) {
    return std::any_of(collider.hulls.begin(), collider.hulls.end(), [&](const auto& hull) {
      return hull.SignedDistance(point.position) < point.radius;
    });
  });
}

// Which colliders none of a spring's points touches.
std::vector<std::size_t> FreeOf(const std::vector<SpringPoint>& points,
                                const std::vector<VrmCollider>& colliders) {
  std::vector<std::size_t> free;
  for (std::size_t c = 0; c < colliders.size(); ++c) {
    if (!Touches(points, colliders[c])) free.push_back(c);
  }
  return free;
}

class VrmWriter {
 public:
  VrmWriter(const ColliderSet& set, GltfDocument document, const VrmOptions& options)
      : set_(set),
        document_(std::move(document)),
        options_(options),
        overshoot_(options.max_overshoot_m / set.body_from_mesh.scale) {}

  absl::StatusOr<Exported> Run() {
    CAPFIT_ASSIGN_OR_RETURN(JointNodes joints, JointNodes::Create(set_, document_));
    const json& extensions = formats::ValueAt(document_.root(), "extensions");
    const bool is_first = !formats::ValueAt(extensions, "VRMC_vrm").is_object();
    if (is_first && !formats::ValueAt(extensions, "VRM").is_object()) {
      return formats::FileError(ErrorReason::kUnsupportedFile, {},
                                "is no VRM: it has neither VRMC_vrm nor VRM; export as glTF");
    }
    for (const Solid& solid : SolidsOf(set_)) AddShapes(solid, is_first, joints);
    Exported exported;
    exported.warnings = std::move(joints).TakeWarnings();
    AddExtras(set_, document_.root(), exported.warnings);
    CAPFIT_RETURN_IF_ERROR(is_first ? WriteFirst() : WriteSecond());
    AddWarnings(is_first, exported.warnings);
    CAPFIT_ASSIGN_OR_RETURN(std::string bytes, document_.Bytes());
    exported.files.push_back({FileStem(set_) + "_colliders.vrm", std::move(bytes)});
    return exported;
  }

 private:
  // VRM 0: spheres, in one group; VRM 1.0: a collider for each piece.
  void AddShapes(const Solid& solid, bool is_first, JointNodes& joints) {
    const std::size_t node = joints.UnscaledNodeOf(solid.joint);
    if (is_first) {
      VrmCollider& collider = colliders_.emplace_back(VrmCollider{solid.name, node, {}, {}});
      for (const geometry::Sphere& sphere : SphereChain(solid.hull, overshoot_)) {
        collider.Add({sphere.center_m, sphere.center_m, sphere.radius_m});
      }
      return;
    }
    for (const UniformPiece& piece : UniformPieces(solid.hull, overshoot_)) {
      colliders_.emplace_back(VrmCollider{solid.name, node, {}, {}}).Add(piece);
    }
  }

  [[nodiscard]] Eigen::Vector3d InNode(const VrmCollider& collider,
                                       const Eigen::Vector3d& point) const {
    return document_.ToWorld(collider.node).inverse() * point;
  }

  absl::Status WriteSecond() {
    json& extension = document_.Extension(document_.root(), kSpringBone);
    if (!extension.contains("specVersion")) extension["specVersion"] = "1.0";
    json& colliders = ListIn(extension, "colliders");
    first_ = colliders.size();
    for (const VrmCollider& collider : colliders_) colliders.push_back(ColliderOf(collider));
    std::vector<std::size_t> all(colliders_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    (void)GroupOf(all, extension);
    if (!options_.joins_springs || !formats::ValueAt(extension, "springs").is_array()) {
      return absl::OkStatus();
    }
    for (json& spring : extension["springs"]) {
      if (!spring.is_object()) continue;
      CAPFIT_ASSIGN_OR_RETURN(const std::vector<std::size_t> free,
                              FreeColliders(SpringPoints(document_, spring)));
      if (!free.empty()) ListIn(spring, "colliderGroups").push_back(GroupOf(free, extension));
    }
    return absl::OkStatus();
  }

  json ColliderOf(const VrmCollider& collider) const {
    const UniformPiece& piece = collider.pieces.front();
    json shape = {{"offset", NumbersIn(InNode(collider, piece.a))}, {"radius", piece.radius_m}};
    if (!piece.IsBall()) shape["tail"] = NumbersIn(InNode(collider, piece.b));
    return {{"node", collider.node},
            {"shape", {{piece.IsBall() ? "sphere" : "capsule", std::move(shape)}}},
            {"extras", {{"capfit", collider.name}}}};
  }

  // The group of exactly these colliders, added where there is none yet.
  std::size_t GroupOf(const std::vector<std::size_t>& members, json& extension) {
    const auto [found, is_new] = groups_.try_emplace(members, 0);
    if (!is_new) return found->second;
    json& groups = ListIn(extension, "colliderGroups");
    found->second = groups.size();
    json indices = json::array();
    for (const std::size_t member : members) indices.push_back(first_ + member);
    const std::size_t number = groups_.size() - 1;
    groups.push_back({{"name", number == 0 ? "capfit" : absl::StrCat("capfit_", number)},
                      {"colliders", std::move(indices)}});
    return found->second;
  }

  absl::Status WriteFirst() {
    json& animation = ObjectIn(document_.root()["extensions"]["VRM"], "secondaryAnimation");
    json& groups = ListIn(animation, "colliderGroups");
    first_ = groups.size();
    for (const VrmCollider& collider : colliders_) groups.push_back(GroupOf(collider));
    json& springs = ListIn(animation, "boneGroups");
    if (!options_.joins_springs) return absl::OkStatus();
    for (json& spring : springs) {
      if (!spring.is_object()) continue;
      CAPFIT_ASSIGN_OR_RETURN(const std::vector<std::size_t> free,
                              FreeColliders(BoneGroupPoints(document_, spring)));
      for (const std::size_t c : free) ListIn(spring, "colliderGroups").push_back(first_ + c);
    }
    return absl::OkStatus();
  }

  json GroupOf(const VrmCollider& collider) const {
    json spheres = json::array();
    for (const UniformPiece& piece : collider.pieces) {
      const Eigen::Vector3d at = InNode(collider, piece.a);
      spheres.push_back(
          {{"offset", {{"x", at.x()}, {"y", at.y()}, {"z", -at.z()}}}, {"radius", piece.radius_m}});
    }
    return {{"node", collider.node}, {"colliders", std::move(spheres)}};
  }

  // Of the next spring: which colliders it may be joined to.
  absl::StatusOr<std::vector<std::size_t>> FreeColliders(const std::vector<SpringPoint>& points) {
    ++springs_;
    points_ += points.size();
    if (springs_ > kMostSprings) {
      return formats::FileTooLarge({}, springs_, "springs", kMostSprings);
    }
    if (points_ > kMostSpringPoints) {
      return formats::FileTooLarge({}, points_, "joints that springs move", kMostSpringPoints);
    }
    std::vector<std::size_t> free = FreeOf(points, colliders_);
    if (free.size() < colliders_.size()) ++springs_inside_;
    return free;
  }

  void AddWarnings(bool is_first, std::vector<Warning>& warnings) const {
    AddUnitWarning(set_, warnings);
    std::size_t pieces = 0;
    for (const VrmCollider& collider : colliders_) pieces += collider.pieces.size();
    warnings.push_back(
        {"CAPSULES_REPLACED",
         absl::StrCat(
             is_first ? "VRM 0 knows spheres only" : "VRM knows capsules of one radius only", ": ",
             SolidsOf(set_).size(), " solids became ", pieces,
             ", which contain them and are up to ", 1e3 * options_.max_overshoot_m, " mm larger"),
         static_cast<std::int64_t>(pieces)});
    if (springs_inside_ == 0) return;
    warnings.push_back({"SPRINGS_INSIDE",
                        absl::StrCat(springs_inside_, " of ", springs_,
                                     " springs lie partly inside of colliders at rest, and are not "
                                     "joined to those"),
                        springs_inside_});
  }

  const ColliderSet& set_;
  GltfDocument document_;
  VrmOptions options_;
  double overshoot_;  // in the file's unit
  std::vector<VrmCollider> colliders_;
  std::size_t first_ = 0;  // index of the first of ours in the file's list
  std::map<std::vector<std::size_t>, std::size_t> groups_;
  std::size_t springs_ = 0;
  std::size_t points_ = 0;  // of all springs
  std::int64_t springs_inside_ = 0;
};

}  // namespace

absl::StatusOr<Exported> WriteVrm(const ColliderSet& set, std::span<const std::byte> original,
                                  const VrmOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  if (!(options.max_overshoot_m >= kLeastOvershootM &&
        options.max_overshoot_m <= kLargestOvershootM)) {
    return OutOfRange("max_overshoot_m", options.max_overshoot_m, kLeastOvershootM,
                      kLargestOvershootM);
  }
  CAPFIT_ASSIGN_OR_RETURN(GltfDocument document, GltfDocument::Open(original));
  return VrmWriter(set, std::move(document), options).Run();
}

}  // namespace capfit::exports
