#include "core/formats/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::formats {
namespace {

constexpr std::uint16_t kOldestBitstream = 0x0202;  // glTF's, 2.2
// Draco's tables take some 200 bytes for each face and, with the Edgebreaker, as many for each
// attribute that has seams of its own; a file claims that in a few bytes. Avatars have up to ten
// attributes, seams in three.
constexpr std::uint64_t kMostSeamTables = 16;
constexpr int kMostAttributeDecoders = 32;
// Bodies take a byte or two for a face; only a flat sheet comes near to this.
constexpr std::uint64_t kMostFacesPerByte = 256;

// What the decoders hold against the limits, and the first thing that was too much.
struct DracoGuard {
  std::size_t packed_bytes = 0;
  const MeshLimits& limits;
  GltfFile& file;
  const FilePlace& place;
  absl::Status refusal = absl::OkStatus();

  bool Refuse(absl::Status status) {
    if (refusal.ok()) refusal = std::move(status);
    return false;
  }
  bool CheckFaces(std::uint64_t faces, std::uint64_t vertices, std::uint64_t tables) {
    const std::uint64_t most_faces =
        std::min<std::uint64_t>(limits.max_faces, kMostFacesPerByte * packed_bytes);
    if (faces > most_faces) return Refuse(FileTooLarge(place, faces, "faces", most_faces));
    if (vertices > std::min<std::uint64_t>(limits.max_vertices, 3 * faces)) {
      return Refuse(FileTooLarge(place, vertices, "vertices",
                                 std::min<std::uint64_t>(limits.max_vertices, 3 * faces)));
    }
    const std::uint64_t most = 8 * static_cast<std::uint64_t>(limits.max_faces);
    if (tables > kMostSeamTables || faces * (tables + 1) > most) {
      return Refuse(FileError(ErrorReason::kTooLarge, place,
                              absl::StrCat("its Draco data has ", tables,
                                           " attributes with seams for ", faces, " faces")));
    }
    return true;
  }
  // The values that all attributes will take, once while they are decoded and once as results.
  bool CheckAttributes(const draco::PointCloud& cloud) {
    if (cloud.num_points() > limits.max_vertices) {
      return Refuse(FileTooLarge(place, cloud.num_points(), "vertices", limits.max_vertices));
    }
    std::uint64_t bytes = 0;
    for (int a = 0; a < cloud.num_attributes(); ++a) {
      const draco::PointAttribute& attribute = *cloud.attribute(a);
      bytes += 4u * static_cast<std::uint64_t>(attribute.num_components()) +
               static_cast<std::uint64_t>(attribute.byte_stride());
    }
    const absl::Status claimed = file.Claim(bytes * cloud.num_points(), place);
    return claimed.ok() || Refuse(claimed);
  }
};

// Draco's own decoders, with the guard asked before they take memory.
template <typename Decoder>
class GuardedDecoder final : public Decoder {
 public:
  explicit GuardedDecoder(DracoGuard& guard) : guard_(guard) {}

 protected:
  // Reads ahead what the connectivity begins with: for the Edgebreaker the numbers of vertices,
  // faces and attributes with seams, else those of faces and points.
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    std::uint8_t tables = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    if constexpr (std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>) {
      if (!ahead.Decode(&tables)) return false;
      std::swap(first, second);
    }
    return guard_.CheckFaces(first, second, tables) && Decoder::DecodeConnectivity();
  }
  bool CreateAttributesDecoder(int32_t id) override {
    return id < kMostAttributeDecoders && Decoder::CreateAttributesDecoder(id);
  }
  bool DecodeAllAttributes() override {
    return guard_.CheckAttributes(*this->point_cloud()) && Decoder::DecodeAllAttributes();
  }

 private:
  DracoGuard& guard_;
};

absl::Status Damaged(const FilePlace& place, const std::string& why) {
  return FileError(ErrorReason::kMalformedFile, place,
                   absl::StrCat("its Draco data is damaged", why.empty() ? "" : ": ", why));
}

absl::Status CheckHeader(std::span<const std::byte> packed, draco::DracoHeader& header,
                         const FilePlace& place) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() ||
      std::memcmp(header.draco_string, "DRACO", 5) != 0) {
    return Damaged(place, "it has no header");
  }
  const int version = DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor);
  const bool has_metadata = (header.flags & METADATA_FLAG_MASK) != 0;
  if (header.encoder_type != draco::TRIANGULAR_MESH ||
      header.encoder_method > draco::MESH_EDGEBREAKER_ENCODING || version < kOldestBitstream ||
      has_metadata) {
    return FileError(ErrorReason::kUnsupportedFile, place,
                     "its Draco data is a point cloud, has metadata, or is older than version 2.2: "
                     "export uncompressed");
  }
  return absl::OkStatus();
}

template <typename Decoder>
draco::Status DecodeWith(std::span<const std::byte> packed, DracoGuard& guard, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
  const draco::DecoderOptions options;
  GuardedDecoder<Decoder> decoder(guard);
  return decoder.Decode(options, &buffer, &mesh);
}

std::optional<GltfComponent> ComponentOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return GltfComponent::kInt8;
    case draco::DT_UINT8:
      return GltfComponent::kUint8;
    case draco::DT_INT16:
      return GltfComponent::kInt16;
    case draco::DT_UINT16:
      return GltfComponent::kUint16;
    case draco::DT_UINT32:
      return GltfComponent::kUint32;
    case draco::DT_FLOAT32:
      return GltfComponent::kFloat32;
    default:
      return std::nullopt;
  }
}

// The values point by point; nothing where there are none that glTF knows.
std::optional<GltfAccessor> ValuesOf(const draco::Mesh& mesh,
                                     const draco::PointAttribute& attribute) {
  const std::optional<GltfComponent> type = ComponentOf(attribute.data_type());
  const std::size_t stride = attribute.byte_stride();
  const std::size_t components = attribute.num_components();
  if (!type.has_value() || components == 0 ||
      stride != components * draco::DataTypeLength(attribute.data_type())) {
    return std::nullopt;
  }
  if (!attribute.is_mapping_identity() && attribute.indices_map_size() < mesh.num_points()) {
    return std::nullopt;
  }
  const std::size_t held = attribute.buffer() == nullptr ? 0 : attribute.buffer()->data_size();
  std::vector<std::byte> bytes(mesh.num_points() * stride);
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    const std::uint32_t value = attribute.mapped_index(draco::PointIndex(p)).value();
    if (value >= attribute.size() || (value + std::uint64_t{1}) * stride > held)
      return std::nullopt;
    attribute.GetValue(draco::AttributeValueIndex(value), bytes.data() + p * stride);
  }
  return GltfAccessor::FromBytes(std::move(bytes), components, *type, false);
}

absl::StatusOr<DracoPrimitive> PrimitiveOf(const draco::Mesh& mesh,
                                           std::span<const std::uint32_t> attributes,
                                           const FilePlace& place) {
  DracoPrimitive primitive;
  primitive.corners.reserve(std::size_t{3} * mesh.num_faces());
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) {
      if (corner.value() >= mesh.num_points()) return Damaged(place, "a face has no such point");
      primitive.corners.push_back(corner.value());
    }
  }
  for (const std::uint32_t id : attributes) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(id);
    if (attribute == nullptr) continue;
    std::optional<GltfAccessor> values = ValuesOf(mesh, *attribute);
    if (!values.has_value()) return Damaged(place, "an attribute has no values of a known type");
    primitive.attributes.emplace(id, *std::move(values));
  }
  return primitive;
}

}  // namespace

absl::StatusOr<DracoPrimitive> DecodeDraco(std::span<const std::byte> packed,
                                           std::span<const std::uint32_t> attributes,
                                           const MeshLimits& limits, GltfFile& file,
                                           const FilePlace& place) {
  draco::DracoHeader header;
  CAPFIT_RETURN_IF_ERROR(CheckHeader(packed, header, place));
  DracoGuard guard{packed.size(), limits, file, place};
  draco::Mesh mesh;
  draco::Status decoded;
  try {  // its containers may run out of memory, or find themselves asked for too much
    decoded = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING
                  ? DecodeWith<draco::MeshEdgebreakerDecoder>(packed, guard, mesh)
                  : DecodeWith<draco::MeshSequentialDecoder>(packed, guard, mesh);
  } catch (const std::exception& thrown) {
    return Damaged(place, thrown.what());
  }
  CAPFIT_RETURN_IF_ERROR(guard.refusal);
  if (!decoded.ok()) return Damaged(place, Printable(decoded.error_msg_string()));
  return PrimitiveOf(mesh, attributes, place);
}

}  // namespace capfit::formats
