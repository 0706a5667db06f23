#include "core/formats/gltf_primitive.h"

#include <array>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/gltf_json.h"

namespace capfit::formats {
namespace {

using nlohmann::json;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr std::array<const char*, 2> kJoints = {"JOINTS_0", "JOINTS_1"};
constexpr std::array<const char*, 2> kWeights = {"WEIGHTS_0", "WEIGHTS_1"};

// Draco's number of an attribute.
std::optional<std::uint32_t> PackedId(const json& packed, const std::string& name) {
  const auto id = IndexAt(ValueAt(packed, "attributes"), name.c_str(), std::size_t{1} << 32);
  return id.has_value() ? std::optional(static_cast<std::uint32_t>(*id)) : std::nullopt;
}

absl::Status TooFew(const FilePlace& place, const std::string& what, std::size_t count,
                    std::size_t vertices) {
  return FileError(ErrorReason::kCountMismatch, place,
                   absl::StrCat("it has ", vertices, " vertices with only ", count, " of ", what),
                   ValueAndLimit(count, vertices));
}

}  // namespace

absl::StatusOr<std::size_t> PrimitiveMode(const json& primitive, const FilePlace& place) {
  if (!primitive.is_object()) {
    return FileError(ErrorReason::kMalformedFile, place, "it is no object");
  }
  if (!primitive.contains("mode")) return kTriangles;
  const std::optional<std::size_t> mode = IndexAt(primitive, "mode", kTriangleFan + 1);
  if (!mode.has_value()) return BadIndexAt(place, primitive, "mode", kTriangleFan + 1);
  return *mode;
}

absl::StatusOr<GltfPrimitive> GltfPrimitive::Open(GltfFile& file, const json& primitive,
                                                  std::span<const double> morph_weights,
                                                  const MeshLimits& limits,
                                                  const FilePlace& place) {
  GltfPrimitive result(file, primitive, place);
  CAPFIT_RETURN_IF_ERROR(result.FindPositions(limits));
  CAPFIT_RETURN_IF_ERROR(result.FindMorphs(morph_weights));
  CAPFIT_RETURN_IF_ERROR(result.FindInfluences());
  return result;
}

absl::StatusOr<std::size_t> GltfPrimitive::AccessorAt(const json& parent, const char* key) const {
  const std::size_t limit = ArrayAt(file_->description(), "accessors").size();
  const std::optional<std::size_t> index = IndexAt(parent, key, limit);
  if (!index.has_value()) return BadIndexAt(place_, parent, key, limit);
  return *index;
}

absl::Status GltfPrimitive::FindPositions(const MeshLimits& limits) {
  if (!primitive_->contains("attributes")) {
    return FileError(ErrorReason::kMalformedFile, place_, "attributes are missing");
  }
  CAPFIT_ASSIGN_OR_RETURN(const std::size_t index,
                          AccessorAt(ValueAt(*primitive_, "attributes"), "POSITION"));
  position_name_ = absl::StrCat("accessor ", index);
  vertex_key_ = {index};
  corner_key_ = kNone;
  const json& packed = ExtensionAt(*primitive_, kDracoExtension);
  if (packed.is_object()) {
    CAPFIT_RETURN_IF_ERROR(Unpack(packed, limits));
  } else if (primitive_->contains("indices")) {
    CAPFIT_ASSIGN_OR_RETURN(corner_key_, AccessorAt(*primitive_, "indices"));
  }
  CAPFIT_ASSIGN_OR_RETURN(positions_, AttributeAt("POSITION", "VEC3"));
  return absl::OkStatus();
}

absl::Status GltfPrimitive::Unpack(const json& packed, const MeshLimits& limits) {
  const std::size_t views = ArrayAt(file_->description(), "bufferViews").size();
  const std::optional<std::size_t> view = IndexAt(packed, "bufferView", views);
  if (!view.has_value()) return BadIndexAt(place_, packed, "bufferView", views);
  std::vector<std::uint32_t> wanted;
  for (const char* const name : {"POSITION", kJoints[0], kJoints[1], kWeights[0], kWeights[1]}) {
    const std::optional<std::uint32_t> id = PackedId(packed, name);
    vertex_key_.push_back(id.value_or(kNone));
    if (id.has_value()) wanted.push_back(*id);
  }
  vertex_key_.push_back(*view);
  corner_key_ = *view;
  CAPFIT_ASSIGN_OR_RETURN(const std::span<const std::byte> bytes, file_->View(*view));
  CAPFIT_ASSIGN_OR_RETURN(unpacked_, DecodeDraco(bytes, wanted, limits, *file_, place_));
  return absl::OkStatus();
}

absl::StatusOr<GltfAccessor> GltfPrimitive::AttributeAt(const std::string& name, const char* type) {
  CAPFIT_ASSIGN_OR_RETURN(const std::size_t index,
                          AccessorAt(ValueAt(*primitive_, "attributes"), name.c_str()));
  const std::optional<std::uint32_t> id = PackedId(ExtensionAt(*primitive_, kDracoExtension), name);
  if (!unpacked_.has_value() || !id.has_value()) return GltfAccessor::Create(*file_, index, type);
  const auto found = unpacked_->attributes.find(*id);
  const std::size_t components = std::string_view(type) == "VEC3" ? 3 : 4;
  if (found == unpacked_->attributes.end() || found->second.components() != components) {
    return FileError(ErrorReason::kMalformedFile, place_,
                     absl::StrCat("its Draco data has no ", name, " of type ", type));
  }
  const json& accessor = ArrayAt(file_->description(), "accessors")[index];
  return found->second.WithNormalized(ValueAt(accessor, "normalized") == true);
}

absl::Status GltfPrimitive::FindMorphs(std::span<const double> weights) {
  const json& targets = ArrayAt(*primitive_, "targets");
  for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
    if (weights[t] == 0.0 || !ValueAt(targets[t], "POSITION").is_number()) continue;
    CAPFIT_ASSIGN_OR_RETURN(const std::size_t accessor, AccessorAt(targets[t], "POSITION"));
    targets_.push_back({accessor, weights[t]});
    vertex_key_.push_back(t);
    vertex_key_.push_back(accessor);
  }
  return absl::OkStatus();
}

absl::Status GltfPrimitive::FindInfluences() {
  const json& attributes = ValueAt(*primitive_, "attributes");
  while (influence_sets_ < kJoints.size() && attributes.contains(kJoints[influence_sets_]) &&
         attributes.contains(kWeights[influence_sets_])) {
    for (const char* const name : {kJoints[influence_sets_], kWeights[influence_sets_]}) {
      CAPFIT_ASSIGN_OR_RETURN(const std::size_t accessor, AccessorAt(attributes, name));
      vertex_key_.push_back(accessor);
    }
    ++influence_sets_;
  }
  return absl::OkStatus();
}

absl::StatusOr<std::vector<MorphTarget>> GltfPrimitive::Morphs() {
  std::vector<MorphTarget> morphs;
  for (const Target& target : targets_) {
    CAPFIT_ASSIGN_OR_RETURN(GltfAccessor displacements,
                            GltfAccessor::Create(*file_, target.accessor, "VEC3"));
    if (displacements.count() < vertex_count()) {
      return TooFew(place_, "a morph target", displacements.count(), vertex_count());
    }
    morphs.push_back({std::move(displacements), target.weight});
  }
  return morphs;
}

absl::StatusOr<std::vector<InfluenceSet>> GltfPrimitive::Influences() {
  std::vector<InfluenceSet> sets;
  for (std::size_t s = 0; s < influence_sets_; ++s) {
    CAPFIT_ASSIGN_OR_RETURN(GltfAccessor joints, AttributeAt(kJoints[s], "VEC4"));
    CAPFIT_ASSIGN_OR_RETURN(GltfAccessor weights, AttributeAt(kWeights[s], "VEC4"));
    if (!joints.IsUnsigned()) {
      return FileError(ErrorReason::kMalformedFile, place_,
                       absl::StrCat(kJoints[s], " must be of unsigned numbers"));
    }
    const std::size_t count = std::min(joints.count(), weights.count());
    if (count < vertex_count()) return TooFew(place_, kJoints[s], count, vertex_count());
    sets.push_back({std::move(joints), std::move(weights)});
  }
  return sets;
}

absl::StatusOr<std::vector<std::uint32_t>> GltfPrimitive::Corners(const MeshLimits& limits) {
  std::vector<std::uint32_t> corners;
  if (unpacked_.has_value()) {
    // The positions may be those of an accessor beside the packed data, and fewer.
    corners = std::move(unpacked_->corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] < vertex_count()) continue;
      return FileOutOfRange(place_, "a packed index", std::uint64_t{corners[i]},
                            IndexRange(vertex_count()));
    }
    return corners;
  }
  if (corner_key_ == kNone) {
    corners.resize(vertex_count());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }
  CAPFIT_ASSIGN_OR_RETURN(const GltfAccessor indices,
                          GltfAccessor::Create(*file_, corner_key_, "SCALAR"));
  const std::string name = absl::StrCat("accessor ", corner_key_);
  if (!indices.IsUnsigned()) {
    return FileError(ErrorReason::kMalformedFile, AtElement(name),
                     "it has indices, which must be unsigned");
  }
  if (indices.count() > 3 * limits.max_faces) {
    return FileTooLarge(AtElement(name), (indices.count() + 2) / 3, "faces", limits.max_faces);
  }
  corners.resize(indices.count());
  for (std::size_t i = 0; i < indices.count(); ++i) {
    const double vertex = indices.At(i, 0);
    if (!(vertex < static_cast<double>(vertex_count()))) {
      return FileOutOfRange(AtRow(name, i), "the index", static_cast<std::uint64_t>(vertex),
                            IndexRange(vertex_count()));
    }
    corners[i] = static_cast<std::uint32_t>(vertex);
  }
  return corners;
}

}  // namespace capfit::formats
