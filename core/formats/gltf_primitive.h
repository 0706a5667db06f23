// One primitive of a glTF mesh: where its numbers are, plain or packed by Draco.
#ifndef CAPFIT_CORE_FORMATS_GLTF_PRIMITIVE_H_
#define CAPFIT_CORE_FORMATS_GLTF_PRIMITIVE_H_

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_draco.h"
#include "core/formats/gltf_file.h"
#include "core/formats/gltf_vertices.h"
#include "core/formats/mesh_limits.h"

namespace capfit::formats {

inline constexpr std::size_t kTriangles = 4;  // `mode` of a primitive
inline constexpr std::size_t kTriangleStrip = 5;
inline constexpr std::size_t kTriangleFan = 6;

// `mode`, kTriangles where the primitive says nothing; less for points and lines.
[[nodiscard]] absl::StatusOr<std::size_t> PrimitiveMode(const nlohmann::json& primitive,
                                                        const FilePlace& place);

class GltfPrimitive {
 public:
  // `morph_weights`: those of the primitive's targets, in order; those beyond count as 0. Unpacks
  // Draco's data where there are any.
  [[nodiscard]] static absl::StatusOr<GltfPrimitive> Open(GltfFile& file,
                                                          const nlohmann::json& primitive,
                                                          std::span<const double> morph_weights,
                                                          const MeshLimits& limits,
                                                          const FilePlace& place);

  // Tells vertices from each other: the accessors they come from. Two primitives of one mesh with
  // the same key have the same vertices.
  [[nodiscard]] const std::vector<std::size_t>& vertex_key() const { return vertex_key_; }
  // The same for its corners; together with the vertex key and the mode, for its faces.
  [[nodiscard]] std::size_t corner_key() const { return corner_key_; }
  // "accessor 3": what to name in errors.
  [[nodiscard]] const std::string& position_name() const { return position_name_; }

  [[nodiscard]] const GltfAccessor& positions() const { return *positions_; }
  [[nodiscard]] std::size_t vertex_count() const { return positions_->count(); }

  // Those targets that count.
  [[nodiscard]] absl::StatusOr<std::vector<MorphTarget>> Morphs();
  // Empty where nothing is skinned, else one or two.
  [[nodiscard]] absl::StatusOr<std::vector<InfluenceSet>> Influences();
  // Indices of its own vertices, in range.
  [[nodiscard]] absl::StatusOr<std::vector<std::uint32_t>> Corners(const MeshLimits& limits);

 private:
  GltfPrimitive(GltfFile& file, const nlohmann::json& primitive, const FilePlace& place)
      : file_(&file), primitive_(&primitive), place_(place) {}

  absl::Status FindPositions(const MeshLimits& limits);
  absl::Status Unpack(const nlohmann::json& packed, const MeshLimits& limits);
  absl::Status FindMorphs(std::span<const double> weights);
  absl::Status FindInfluences();
  [[nodiscard]] absl::StatusOr<std::size_t> AccessorAt(const nlohmann::json& parent,
                                                       const char* key) const;
  // Of an attribute, plain or unpacked.
  [[nodiscard]] absl::StatusOr<GltfAccessor> AttributeAt(const std::string& name, const char* type);

  struct Target {
    std::size_t accessor = 0;
    double weight = 0.0;
  };

  GltfFile* file_;
  const nlohmann::json* primitive_;
  FilePlace place_;
  std::optional<DracoPrimitive> unpacked_;
  std::optional<GltfAccessor> positions_;
  std::string position_name_;
  std::vector<std::size_t> vertex_key_;
  std::size_t corner_key_ = 0;
  std::vector<Target> targets_;
  std::size_t influence_sets_ = 0;
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_PRIMITIVE_H_
