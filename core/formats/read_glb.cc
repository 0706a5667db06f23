#include "core/formats/read_glb.h"

#include <Eigen/Geometry>  // homogeneous
#include <Eigen/LU>        // determinant, inverse
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/glb_file.h"
#include "core/formats/gltf_nodes.h"
#include "core/formats/recover_decimals.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

constexpr std::size_t kTriangles = 4;  // `mode` of a primitive
constexpr std::size_t kTriangleStrip = 5;
constexpr std::size_t kTriangleFan = 6;

// A skeleton of a human has some 70 joints, with every finger and hair strand some hundred.
constexpr std::size_t kMostJoints = 4096;
// A longer name is none of a bone.
constexpr std::size_t kLongestName = 256;
// Few kilobytes of JSON may ask for the same primitives again and again: nodes share meshes.
constexpr std::size_t kMostPrimitives = 100'000;

// Half the distance of two floats, at most, as a share of their size.
constexpr double kFloatShare = 0x1p-24;

Eigen::Vector3d Apply(const Eigen::Matrix4d& transform, const Eigen::Vector3d& point) {
  return (transform * point.homogeneous()).head<3>();
}

// Whether it leaves a body a body: zeros are common where an exporter knew no bind pose.
bool IsTransform(const Eigen::Matrix4d& matrix) {
  return matrix.allFinite() && std::abs(matrix.topLeftCorner<3, 3>().determinant()) > 0.0;
}

class GlbReader {
 public:
  GlbReader(const GlbFile& file, const GltfNodes& nodes, const MeshLimits& limits)
      : file_(file), nodes_(nodes), limits_(limits) {}

  absl::StatusOr<PolygonSoup> Run() {
    const json& nodes = ArrayAt(file_.json, "nodes");
    const json& meshes = ArrayAt(file_.json, "meshes");
    for (const std::size_t n : nodes_.drawn) {
      const std::optional<std::size_t> mesh = IndexAt(nodes[n], "mesh", meshes.size());
      if (!mesh.has_value()) continue;
      CAPFIT_ASSIGN_OR_RETURN(const Eigen::Matrix4d to_world, Place(nodes[n], n));
      base_of_positions_.clear();
      const json& primitives = ArrayAt(meshes[*mesh], "primitives");
      drawn_primitives_ += primitives.size();
      if (drawn_primitives_ > kMostPrimitives) {
        return FileTooLarge(AtElement(absl::StrCat("node ", n)), drawn_primitives_,
                            "drawn primitives", kMostPrimitives);
      }
      for (std::size_t p = 0; p < primitives.size(); ++p) {
        CAPFIT_RETURN_IF_ERROR(AddPrimitive(primitives[p], {n, *mesh, p}, to_world));
      }
    }
    if (soup_.face_vertices.empty()) {
      return FileError(ErrorReason::kMissing, {}, "has no mesh: its scene draws no triangles");
    }
    // (What no transform moved is for PrepareMesh to look at.)
    if (rounding_ > 0.0) {
      std::vector<Eigen::Vector3d> decimals = RecoverDecimals(soup_.positions, rounding_);
      if (!decimals.empty()) soup_.positions = std::move(decimals);
    }
    return std::move(soup_);
  }

 private:
  // Where a node's mesh stands. A skinned mesh follows its joints, not its node.
  absl::StatusOr<Eigen::Matrix4d> Place(const json& node, std::size_t index) {
    const json& skins = ArrayAt(file_.json, "skins");
    const std::optional<std::size_t> skin_index = IndexAt(node, "skin", skins.size());
    if (!skin_index.has_value()) return nodes_.to_world[index];
    auto read = skins_read_.find(*skin_index);
    if (read == skins_read_.end()) {
      const FilePlace place = AtElement(absl::StrCat("skin ", *skin_index));
      CAPFIT_ASSIGN_OR_RETURN(const std::optional<Eigen::Matrix4d> bound,
                              ReadSkin(skins[*skin_index], place));
      read = skins_read_.emplace(*skin_index, bound).first;
    }
    return read->second.value_or(nodes_.to_world[index]);
  }

  // Adds the skin's joints. Where the meshes stand that it binds: at the bind pose each joint moves
  // them by the same matrix, so the first joint's will do; nothing where it does not say.
  absl::StatusOr<std::optional<Eigen::Matrix4d>> ReadSkin(const json& skin,
                                                          const FilePlace& place) {
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<std::size_t> joints, JointsOf(skin, place));
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<Eigen::Matrix4d> to_joint,
                            InverseBindMatrices(skin, joints.size(), place));
    std::optional<Eigen::Matrix4d> to_world;
    if (!joints.empty() && !to_joint.empty()) to_world = nodes_.to_world[joints[0]] * to_joint[0];
    if (to_world.has_value() && !IsTransform(*to_world)) to_world.reset();
    for (std::size_t j = 0; j < joints.size(); ++j) {
      AddJoint(joints[j], to_world.has_value() ? Eigen::Matrix4d(*to_world * to_joint[j].inverse())
                                               : nodes_.to_world[joints[j]]);
    }
    return to_world;
  }

  void AddJoint(std::size_t node_index, const Eigen::Matrix4d& to_world) {
    const json& node = ArrayAt(file_.json, "nodes")[node_index];
    const Eigen::Vector3d position = to_world.col(3).head<3>();
    if (!node.is_object() || !position.allFinite()) return;
    const auto name = node.find("name");
    if (name == node.end() || !name->is_string()) return;  // says nothing without a name
    const auto& text = name->get_ref<const std::string&>();
    if (text.size() > kLongestName || soup_.joints.size() >= kMostJoints) return;
    soup_.joints.push_back({text, position});
  }

  absl::StatusOr<std::vector<std::size_t>> JointsOf(const json& skin,
                                                    const FilePlace& place) const {
    const json& entries = ArrayAt(skin, "joints");
    if (entries.size() > kMostJoints) {
      return FileError(
          ErrorReason::kTooLarge, place,
          absl::StrCat("it has ", entries.size(), " joints, must have at most ", kMostJoints),
          ValueAndLimit(entries.size(), kMostJoints));
    }
    std::vector<std::size_t> joints;
    for (const json& entry : entries) {
      if (!entry.is_number_unsigned()) {
        return FileError(ErrorReason::kMalformedFile, place, "it has a joint that is no index");
      }
      if (entry.get<std::uint64_t>() >= nodes_.to_world.size()) {
        return FileOutOfRange(place, "a joint", entry.get<std::uint64_t>(),
                              IndexRange(nodes_.to_world.size()));
      }
      joints.push_back(entry.get<std::size_t>());
    }
    return joints;
  }

  // Empty where the file has none.
  absl::StatusOr<std::vector<Eigen::Matrix4d>> InverseBindMatrices(const json& skin,
                                                                   std::size_t joints,
                                                                   const FilePlace& place) const {
    std::vector<Eigen::Matrix4d> matrices;
    if (!skin.is_object() || !skin.contains("inverseBindMatrices")) return matrices;
    CAPFIT_ASSIGN_OR_RETURN(const std::size_t index,
                            AccessorAt(skin, "inverseBindMatrices", place));
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor accessor,
                            GltfAccessor::Create(file_, index, "MAT4"));
    if (accessor.count() < joints) {
      return FileError(
          ErrorReason::kCountMismatch, place,
          absl::StrCat("it has ", joints, " joints with only ", accessor.count(), " matrices"),
          ValueAndLimit(accessor.count(), joints));
    }
    for (std::size_t j = 0; j < joints; ++j) {
      Eigen::Matrix4d& matrix = matrices.emplace_back();
      for (Eigen::Index k = 0; k < 16; ++k) matrix(k % 4, k / 4) = accessor.At(j, k);
    }
    return matrices;
  }

  // Which primitive of which mesh, drawn by which node.
  struct Drawing {
    std::size_t node = 0;
    std::size_t mesh = 0;
    std::size_t primitive = 0;

    [[nodiscard]] FilePlace place() const {
      return {absl::StrCat("mesh ", mesh, " primitive ", primitive),
              {{"element", absl::StrCat("mesh ", mesh)}, {"row", absl::StrCat(primitive)}}};
    }
  };

  absl::StatusOr<std::size_t> AccessorAt(const json& parent, const char* key,
                                         const FilePlace& place) const {
    const std::size_t limit = ArrayAt(file_.json, "accessors").size();
    const std::optional<std::size_t> index = IndexAt(parent, key, limit);
    if (!index.has_value()) return BadIndexAt(place, parent, key, limit);
    return *index;
  }

  static absl::StatusOr<std::size_t> ModeOf(const json& primitive, const Drawing& drawing) {
    if (!primitive.is_object()) {
      return FileError(ErrorReason::kMalformedFile, drawing.place(), "it is no object");
    }
    if (!primitive.contains("mode")) return kTriangles;
    const std::optional<std::size_t> mode = IndexAt(primitive, "mode", kTriangleFan + 1);
    if (!mode.has_value()) return BadIndexAt(drawing.place(), primitive, "mode", kTriangleFan + 1);
    return *mode;
  }

  static absl::Status CheckUncompressed(const json& primitive, const Drawing& drawing) {
    const auto extensions = primitive.find("extensions");
    if (extensions != primitive.end() && extensions->is_object() &&
        extensions->contains("KHR_draco_mesh_compression")) {
      return FileError(ErrorReason::kUnsupportedFile, drawing.place(),
                       "it is compressed with Draco, which is not read: export uncompressed");
    }
    return absl::OkStatus();
  }

  absl::Status AddPrimitive(const json& primitive, const Drawing& drawing,
                            const Eigen::Matrix4d& to_world) {
    CAPFIT_ASSIGN_OR_RETURN(const std::size_t mode, ModeOf(primitive, drawing));
    if (mode < kTriangles) return absl::OkStatus();  // points and lines
    CAPFIT_RETURN_IF_ERROR(CheckUncompressed(primitive, drawing));
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end()) {
      return FileError(ErrorReason::kMalformedFile, drawing.place(), "attributes are missing");
    }
    const json& accessors = ArrayAt(file_.json, "accessors");
    const std::optional<std::size_t> position = IndexAt(*attributes, "POSITION", accessors.size());
    if (!position.has_value()) {
      return BadIndexAt(drawing.place(), *attributes, "POSITION", accessors.size());
    }
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor positions,
                            GltfAccessor::Create(file_, *position, "VEC3"));
    CAPFIT_ASSIGN_OR_RETURN(const std::size_t base,
                            AddPositions(*position, positions, drawing, to_world));
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> corners,
                            CornersOf(primitive, drawing, positions.count(), base));
    return AddFaces(mode, drawing, corners, to_world.topLeftCorner<3, 3>().determinant() < 0.0);
  }

  // The soup's index of the accessor's first vertex.
  absl::StatusOr<std::size_t> AddPositions(std::size_t accessor_index,
                                           const GltfAccessor& positions, const Drawing& drawing,
                                           const Eigen::Matrix4d& to_world) {
    const auto [entry, is_new] =
        base_of_positions_.try_emplace(accessor_index, soup_.positions.size());
    if (!is_new) return entry->second;
    if (positions.count() > limits_.max_vertices - soup_.positions.size()) {
      return FileTooLarge(AtElement(absl::StrCat("accessor ", accessor_index)),
                          soup_.positions.size() + positions.count(), "vertices",
                          limits_.max_vertices);
    }
    soup_.positions.reserve(soup_.positions.size() + positions.count());
    double largest = 0.0;
    for (std::size_t i = 0; i < positions.count(); ++i) {
      const Eigen::Vector3d stored(positions.At(i, 0), positions.At(i, 1), positions.At(i, 2));
      const Eigen::Vector3d placed = Apply(to_world, stored);
      if (!IsPosition(placed)) {
        return BadPosition(stored, placed, AtRow(absl::StrCat("accessor ", accessor_index), i),
                           drawing.node);
      }
      largest = std::max(largest, stored.cwiseAbs().maxCoeff());
      soup_.positions.push_back(placed);
    }
    if (!to_world.isIdentity(0.0)) {
      rounding_ = std::max(
          rounding_, kFloatShare * largest * to_world.topLeftCorner<3, 3>().cwiseAbs().maxCoeff());
    }
    return entry->second;
  }

  // A coordinate that is none where the node puts it, and perhaps as it is stored.
  static absl::Status BadPosition(const Eigen::Vector3d& stored, const Eigen::Vector3d& placed,
                                  FilePlace place, std::size_t node) {
    const bool is_placing = IsPosition(stored);
    if (is_placing) absl::StrAppend(&place.text, ", placed by node ", node);
    const Eigen::Vector3d& bad = is_placing ? placed : stored;
    int axis = 0;
    while (axis < 2 && IsCoordinate(bad[axis])) ++axis;
    return BadCoordinate(place, axis, bad[axis]);
  }

  absl::StatusOr<std::vector<std::uint32_t>> CornersOf(const json& primitive,
                                                       const Drawing& drawing, std::size_t vertices,
                                                       std::size_t base) const {
    std::vector<std::uint32_t> corners;
    if (!primitive.contains("indices")) {
      for (std::size_t i = 0; i < vertices; ++i) {
        corners.push_back(static_cast<std::uint32_t>(base + i));
      }
      return corners;
    }
    CAPFIT_ASSIGN_OR_RETURN(const std::size_t index,
                            AccessorAt(primitive, "indices", drawing.place()));
    CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor indices,
                            GltfAccessor::Create(file_, index, "SCALAR"));
    const std::string name = absl::StrCat("accessor ", index);
    if (!indices.IsUnsigned()) {
      return FileError(ErrorReason::kMalformedFile, AtElement(name),
                       "it has indices, which must be unsigned");
    }
    if (indices.count() > 3 * limits_.max_faces) {
      return FileTooLarge(AtElement(name), (indices.count() + 2) / 3, "faces", limits_.max_faces);
    }
    corners.resize(indices.count());
    for (std::size_t i = 0; i < indices.count(); ++i) {
      const double vertex = indices.At(i, 0);
      if (!(vertex < static_cast<double>(vertices))) {
        return FileOutOfRange(AtRow(name, i), "the index", static_cast<std::uint64_t>(vertex),
                              IndexRange(vertices));
      }
      corners[i] = static_cast<std::uint32_t>(base + static_cast<std::size_t>(vertex));
    }
    return corners;
  }

  // A mirroring transform turns faces inside out, which glTF undoes.
  absl::Status AddFaces(std::size_t mode, const Drawing& drawing,
                        const std::vector<std::uint32_t>& corners, bool is_mirrored) {
    const std::size_t count = corners.size();
    const std::size_t faces = mode == kTriangles ? count / 3 : count < 3 ? 0 : count - 2;
    if (faces > limits_.max_faces - soup_.face_count()) {
      return FileTooLarge(drawing.place(), soup_.face_count() + faces, "faces", limits_.max_faces);
    }
    soup_.face_vertices.reserve(soup_.face_vertices.size() + 3 * faces);
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t first = mode == kTriangles ? 3 * f : mode == kTriangleStrip ? f : 0;
      const std::size_t second = mode == kTriangleFan ? f + 1 : first + 1;
      const bool is_turned = mode == kTriangleStrip && f % 2 == 1;
      std::uint32_t b = corners[second];
      std::uint32_t c = corners[second + 1];
      if (is_turned != is_mirrored) std::swap(b, c);
      soup_.face_vertices.insert(soup_.face_vertices.end(), {corners[first], b, c});
    }
    return absl::OkStatus();
  }

  const GlbFile& file_;
  const GltfNodes& nodes_;
  const MeshLimits& limits_;
  PolygonSoup soup_;
  std::map<std::size_t, std::size_t> base_of_positions_;              // of the mesh being read
  std::map<std::size_t, std::optional<Eigen::Matrix4d>> skins_read_;  // where they put meshes
  std::size_t drawn_primitives_ = 0;
  double rounding_ = 0.0;  // of transformed positions, from their storage as floats
};

}  // namespace

absl::StatusOr<PolygonSoup> ReadGlb(std::span<const std::byte> bytes, const MeshLimits& limits) {
  CAPFIT_ASSIGN_OR_RETURN(const GlbFile file, OpenGlb(bytes));
  CAPFIT_ASSIGN_OR_RETURN(const GltfNodes nodes, ReadGltfNodes(file.json));
  return GlbReader(file, nodes, limits).Run();
}

}  // namespace capfit::formats
