#include "core/formats/read_glb.h"

#include <Eigen/Geometry>  // homogeneous
#include <Eigen/LU>        // determinant
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_file.h"
#include "core/formats/gltf_json.h"
#include "core/formats/gltf_nodes.h"
#include "core/formats/gltf_primitive.h"
#include "core/formats/gltf_skins.h"
#include "core/formats/gltf_vertices.h"
#include "core/formats/recover_decimals.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

// Few kilobytes of JSON may ask for the same primitives again and again: nodes share meshes.
constexpr std::size_t kMostPrimitives = 100'000;
// Vertices times morph targets that count. Hundreds of targets are usual, a few of them count.
constexpr std::size_t kMostMorphedRows = 20'000'000;
// Half the distance of two floats, at most, as a share of their size.
constexpr double kFloatShare = 0x1p-24;

// A mesh drawn by a node.
struct DrawnMesh {
  std::size_t node = 0;
  std::size_t mesh = 0;
  const GltfSkin* skin = nullptr;
  Eigen::Matrix4d to_world;  // the node's
  std::vector<double> morph_weights;
};

// Vertices that primitives of one drawn mesh share.
struct SharedVertices {
  std::size_t base = 0;      // the soup's index of the first
  bool is_mirrored = false;  // where they are drawn
};

// The node's weights, else the mesh's.
std::vector<double> MorphWeights(const json& node, const json& mesh) {
  std::vector<double> weights;
  const json& of_node = ArrayAt(node, "weights");
  for (const json& weight : of_node.empty() ? ArrayAt(mesh, "weights") : of_node) {
    weights.push_back(weight.is_number() ? weight.get<double>() : 0.0);
  }
  return weights;
}

Placing PlacingOf(const Eigen::Matrix4d& to_world) { return to_world.topRows<3>(); }

bool IsIdentity(const Placing& placing) {
  return placing == Placing(Eigen::Matrix4d::Identity().topRows<3>());
}

Eigen::Matrix4d TransformOf(const Placing& placing) {
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  transform.topRows<3>() = placing;
  return transform;
}

class GlbReader {
 public:
  GlbReader(GltfFile& file, const GltfNodes& nodes, GltfSkeleton skeleton, const MeshLimits& limits)
      : file_(file), nodes_(nodes), skeleton_(std::move(skeleton)), limits_(limits) {}

  absl::StatusOr<PolygonSoup> Run() {
    for (const std::size_t n : nodes_.drawn) CAPFIT_RETURN_IF_ERROR(AddNode(n));
    if (soup_.face_vertices.empty()) {
      return FileError(ErrorReason::kMissing, {}, "has no mesh: its scene draws no triangles");
    }
    // (What no transform moved is for PrepareMesh to look at.)
    if (rounding_ > 0.0) {
      std::vector<Eigen::Vector3d> decimals = RecoverDecimals(soup_.positions, rounding_);
      if (!decimals.empty()) soup_.positions = std::move(decimals);
    }
    if (!soup_.influences.empty()) soup_.influences.resize(soup_.positions.size());
    soup_.joints = std::move(skeleton_.joints);
    return std::move(soup_);
  }

 private:
  absl::Status AddNode(std::size_t n) {
    const json& node = ArrayAt(file_.description(), "nodes")[n];
    const json& meshes = ArrayAt(file_.description(), "meshes");
    const std::optional<std::size_t> m = IndexAt(node, "mesh", meshes.size());
    if (!m.has_value()) return absl::OkStatus();
    const json& primitives = ArrayAt(meshes[*m], "primitives");
    drawn_primitives_ += primitives.size();
    if (drawn_primitives_ > kMostPrimitives) {
      return FileTooLarge(AtElement(absl::StrCat("node ", n)), drawn_primitives_,
                          "drawn primitives", kMostPrimitives);
    }
    const auto skin =
        skeleton_.skins.find(IndexAt(node, "skin", GltfNodes::kNone).value_or(GltfNodes::kNone));
    const DrawnMesh drawn = {n, *m, skin == skeleton_.skins.end() ? nullptr : &skin->second,
                             nodes_.to_world[n], MorphWeights(node, meshes[*m])};
    vertices_.clear();
    faces_.clear();
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      CAPFIT_RETURN_IF_ERROR(AddPrimitive(primitives[p], drawn, p));
    }
    return absl::OkStatus();
  }

  absl::Status AddPrimitive(const json& primitive, const DrawnMesh& drawn, std::size_t p) {
    const FilePlace place = {
        absl::StrCat("mesh ", drawn.mesh, " primitive ", p),
        {{"element", absl::StrCat("mesh ", drawn.mesh)}, {"row", absl::StrCat(p)}}};
    CAPFIT_ASSIGN_OR_RETURN(const std::size_t mode, PrimitiveMode(primitive, place));
    if (mode < kTriangles) return absl::OkStatus();  // points and lines
    CAPFIT_ASSIGN_OR_RETURN(
        GltfPrimitive opened,
        GltfPrimitive::Open(file_, primitive, drawn.morph_weights, limits_, place));
    CAPFIT_ASSIGN_OR_RETURN(const SharedVertices vertices, VerticesOf(opened, drawn, place));
    const std::size_t first_face = soup_.face_count();
    if (faces_.insert({opened.vertex_key(), opened.corner_key(), mode}).second) {
      CAPFIT_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> corners, opened.Corners(limits_));
      CAPFIT_RETURN_IF_ERROR(AddFaces(mode, place, corners, vertices));
    }
    AddPart(primitive, drawn, first_face);
    return absl::OkStatus();
  }

  void AddPart(const json& primitive, const DrawnMesh& drawn, std::size_t first_face) {
    const json& materials = ArrayAt(file_.description(), "materials");
    SoupPart part;
    part.name = NameAt(ArrayAt(file_.description(), "nodes")[drawn.node], "name");
    if (part.name.empty()) {
      part.name = NameAt(ArrayAt(file_.description(), "meshes")[drawn.mesh], "name");
    }
    if (const auto material = IndexAt(primitive, "material", materials.size())) {
      part.material = NameAt(materials[*material], "name");
    }
    part.first_face = first_face;
    part.face_count = soup_.face_count() - first_face;
    part.joint = RigidJoint(drawn);
    soup_.parts.push_back(std::move(part));
  }

  [[nodiscard]] std::int32_t RigidJoint(const DrawnMesh& drawn) const {
    if (drawn.skin != nullptr || skeleton_.nearest_joint.empty()) return -1;
    return skeleton_.nearest_joint[drawn.node];
  }

  absl::StatusOr<SharedVertices> VerticesOf(GltfPrimitive& primitive, const DrawnMesh& drawn,
                                            const FilePlace& place) {
    const auto [entry, is_new] = vertices_.try_emplace(primitive.vertex_key());
    if (!is_new) return entry->second;
    const std::size_t base = soup_.positions.size();
    if (primitive.vertex_count() > limits_.max_vertices - base) {
      return FileTooLarge(AtElement(primitive.position_name()), base + primitive.vertex_count(),
                          "vertices", limits_.max_vertices);
    }
    entry->second.base = base;
    CAPFIT_RETURN_IF_ERROR(AddStored(primitive, place));
    CAPFIT_ASSIGN_OR_RETURN(const Placing placing, Place(primitive, drawn, base, place));
    entry->second.is_mirrored = placing.leftCols<3>().determinant() < 0.0;
    return entry->second;
  }

  // Positions as the file has them, morphed.
  absl::Status AddStored(GltfPrimitive& primitive, const FilePlace& place) {
    const std::size_t base = soup_.positions.size();
    const GltfAccessor& positions = primitive.positions();
    soup_.positions.resize(base + positions.count());
    for (std::size_t i = 0; i < positions.count(); ++i) {
      soup_.positions[base + i] = positions.VectorAt(i);
    }
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<MorphTarget> morphs, primitive.Morphs());
    morphed_rows_ += morphs.size() * positions.count();
    if (morphed_rows_ > kMostMorphedRows) {
      return FileTooLarge(place, morphed_rows_, "morphed vertices", kMostMorphedRows);
    }
    for (const MorphTarget& morph : morphs) {
      for (std::size_t i = 0; i < positions.count(); ++i) {
        soup_.positions[base + i] += morph.weight * morph.displacements.VectorAt(i);
      }
    }
    return absl::OkStatus();
  }

  // Puts the soup's positions from `base` on where they are drawn. Returns one placing of theirs.
  absl::StatusOr<Placing> Place(GltfPrimitive& primitive, const DrawnMesh& drawn, std::size_t base,
                                const FilePlace& place) {
    const Placing of_node = PlacingOf(drawn.to_world);
    if (drawn.skin == nullptr) {
      HoldRigidly(base, RigidJoint(drawn));
      return PlaceAlike(primitive, drawn, base, of_node);
    }
    const Placing fallback = drawn.skin->first_placing.value_or(of_node);
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<InfluenceSet> sets, primitive.Influences());
    if (sets.empty()) return PlaceAlike(primitive, drawn, base, fallback);
    CAPFIT_ASSIGN_OR_RETURN(const std::vector<SkinInfluences> influences,
                            ReadInfluences(sets, primitive.vertex_count(), *drawn.skin, place));
    Hold(base, influences, *drawn.skin);
    const double largest = LargestFrom(base);
    if (const auto common = CommonPlacing(influences, *drawn.skin, largest)) {
      return PlaceAlike(primitive, drawn, base, *common);
    }
    for (std::size_t i = 0; i < influences.size(); ++i) {
      const Eigen::Vector3d stored = soup_.positions[base + i];
      soup_.positions[base + i] = Skinned(stored, influences[i], *drawn.skin, fallback);
      if (!IsPosition(soup_.positions[base + i])) {
        return BadPosition(stored, soup_.positions[base + i], primitive, i, drawn.node);
      }
    }
    return fallback;
  }

  void HoldRigidly(std::size_t base, std::int32_t joint) {
    if (joint < 0) return;
    JointInfluences rigid;
    rigid.joint[0] = static_cast<std::uint16_t>(joint);
    rigid.weight[0] = 1.0F;
    soup_.influences.resize(base);
    soup_.influences.resize(soup_.positions.size(), rigid);
  }

  void Hold(std::size_t base, const std::vector<SkinInfluences>& influences, const GltfSkin& skin) {
    soup_.influences.resize(base);
    for (const SkinInfluences& of_vertex : influences) {
      soup_.influences.push_back(StrongestFour(of_vertex, skin));
    }
  }

  [[nodiscard]] double LargestFrom(std::size_t base) const {
    double largest = 0.0;
    for (std::size_t i = base; i < soup_.positions.size(); ++i) {
      largest = std::max(largest, soup_.positions[i].cwiseAbs().maxCoeff());
    }
    return largest;
  }

  absl::StatusOr<Placing> PlaceAlike(const GltfPrimitive& primitive, const DrawnMesh& drawn,
                                     std::size_t base, const Placing& placing) {
    const Eigen::Matrix4d transform = TransformOf(placing);
    double largest = 0.0;
    for (std::size_t i = base; i < soup_.positions.size(); ++i) {
      const Eigen::Vector3d stored = soup_.positions[i];
      const Eigen::Vector3d placed = (transform * stored.homogeneous()).head<3>();
      if (!IsPosition(placed)) return BadPosition(stored, placed, primitive, i - base, drawn.node);
      largest = std::max(largest, stored.cwiseAbs().maxCoeff());
      soup_.positions[i] = placed;
    }
    if (!IsIdentity(placing)) {
      rounding_ =
          std::max(rounding_, kFloatShare * largest * placing.leftCols<3>().cwiseAbs().maxCoeff());
    }
    return placing;
  }

  // A coordinate that is none where the node puts it, and perhaps as it is stored.
  static absl::Status BadPosition(const Eigen::Vector3d& stored, const Eigen::Vector3d& placed,
                                  const GltfPrimitive& primitive, std::size_t row,
                                  std::size_t node) {
    FilePlace place = AtRow(primitive.position_name(), row);
    const bool is_placing = IsPosition(stored);
    if (is_placing) absl::StrAppend(&place.text, ", placed by node ", node);
    const Eigen::Vector3d& bad = is_placing ? placed : stored;
    int axis = 0;
    while (axis < 2 && IsCoordinate(bad[axis])) ++axis;
    return BadCoordinate(place, axis, bad[axis]);
  }

  // A mirroring transform turns faces inside out, which glTF undoes.
  absl::Status AddFaces(std::size_t mode, const FilePlace& place,
                        const std::vector<std::uint32_t>& corners, const SharedVertices& vertices) {
    const std::size_t count = corners.size();
    const std::size_t faces = mode == kTriangles ? count / 3 : count < 3 ? 0 : count - 2;
    if (faces > limits_.max_faces - soup_.face_count()) {
      return FileTooLarge(place, soup_.face_count() + faces, "faces", limits_.max_faces);
    }
    const auto base = static_cast<std::uint32_t>(vertices.base);
    const std::size_t before = soup_.face_vertices.size();
    soup_.face_vertices.resize(before + 3 * faces);
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t first = mode == kTriangles ? 3 * f : mode == kTriangleStrip ? f : 0;
      const std::size_t second = mode == kTriangleFan ? f + 1 : first + 1;
      const bool is_turned = mode == kTriangleStrip && f % 2 == 1;
      std::uint32_t b = corners[second];
      std::uint32_t c = corners[second + 1];
      if (is_turned != vertices.is_mirrored) std::swap(b, c);
      std::uint32_t* const face = soup_.face_vertices.data() + before + 3 * f;
      face[0] = base + corners[first];
      face[1] = base + b;
      face[2] = base + c;
    }
    return absl::OkStatus();
  }

  // Vertices, corners, mode.
  using FaceKey = std::tuple<std::vector<std::size_t>, std::size_t, std::size_t>;

  GltfFile& file_;
  const GltfNodes& nodes_;
  GltfSkeleton skeleton_;
  const MeshLimits& limits_;
  PolygonSoup soup_;
  std::map<std::vector<std::size_t>, SharedVertices> vertices_;  // of the mesh being read
  std::set<FaceKey> faces_;
  std::size_t drawn_primitives_ = 0;
  std::size_t morphed_rows_ = 0;
  double rounding_ = 0.0;  // of transformed positions, from their storage as floats
};

}  // namespace

absl::StatusOr<PolygonSoup> ReadGlb(std::span<const std::byte> bytes, const MeshLimits& limits) {
  CAPFIT_ASSIGN_OR_RETURN(GltfFile file, GltfFile::Open(bytes));
  CAPFIT_ASSIGN_OR_RETURN(const GltfNodes nodes, ReadGltfNodes(file.description()));
  CAPFIT_ASSIGN_OR_RETURN(GltfSkeleton skeleton, ReadGltfSkeleton(file, nodes));
  return GlbReader(file, nodes, std::move(skeleton), limits).Run();
}

}  // namespace capfit::formats
