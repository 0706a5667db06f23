// glTF files for tests: a tetrahedron to begin with, and whatever is added to it.
#ifndef CAPFIT_TESTS_CORE_FORMATS_GLTF_MAKER_H_
#define CAPFIT_TESTS_CORE_FORMATS_GLTF_MAKER_H_

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/read_glb.h"
#include "tests/support/told.h"

namespace capfit::formats {

using nlohmann::json;

template <typename Value>
std::string PackedBytes(const std::vector<Value>& values) {
  std::string bytes(values.size() * sizeof(Value), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}
inline std::string PackedWord(std::uint32_t value) {
  return PackedBytes(std::vector<std::uint32_t>{value});
}

inline std::string GlbChunk(std::uint32_t type, std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  return PackedWord(static_cast<std::uint32_t>(bytes.size())) + PackedWord(type) + bytes;
}

inline std::string GlbOf(const json& gltf, const std::string& binary) {
  const std::string chunks =
      GlbChunk(0x4E4F534A, gltf.dump(), ' ') + GlbChunk(0x004E4942, binary, '\0');
  return "glTF" + PackedWord(2) + PackedWord(static_cast<std::uint32_t>(12 + chunks.size())) +
         chunks;
}

// Four vertices and four faces of a tetrahedron: 48 bytes of positions, 24 of 16-bit indices.
inline const std::string kTetrahedronBytes =
    PackedBytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
    PackedBytes<std::uint16_t>({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});

inline json TetrahedronGltf() {
  return json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48},
                    {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "buffers": [{"byteLength": 72}]})");
}

inline absl::StatusOr<PolygonSoup> ReadGltf(const json& gltf,
                                            const std::string& binary = kTetrahedronBytes,
                                            const MeshLimits& limits = {}) {
  const std::string file = GlbOf(gltf, binary);
  return ReadGlb(std::as_bytes(std::span(file)), limits);
}

inline std::string ToldOfGltf(const json& gltf, const std::string& binary = kTetrahedronBytes,
                              const MeshLimits& limits = {}) {
  return Told(ReadGltf(gltf, binary, limits).status());
}

inline std::string ToldOfGlb(const std::string& bytes) {
  return Told(ReadGlb(std::as_bytes(std::span(bytes)), {}).status());
}

// A glTF file that grows.
struct GltfMaker {
  json gltf = TetrahedronGltf();
  std::string binary = kTetrahedronBytes;

  // A buffer view of those bytes.
  std::size_t AddView(std::string bytes) {
    gltf["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    binary += bytes;
    return gltf["bufferViews"].size() - 1;
  }
  std::size_t AddAccessor(const std::string& bytes, int component_type, std::size_t count,
                          const std::string& type, bool normalized = false) {
    json accessor = {{"bufferView", AddView(bytes)},
                     {"componentType", component_type},
                     {"count", count},
                     {"type", type}};
    if (normalized) accessor["normalized"] = true;
    gltf["accessors"].push_back(std::move(accessor));
    return gltf["accessors"].size() - 1;
  }
  // The attributes of the first primitive.
  json& attributes() { return gltf["meshes"][0]["primitives"][0]["attributes"]; }
  [[nodiscard]] absl::StatusOr<PolygonSoup> Read() const { return ReadGltf(gltf, binary); }
  [[nodiscard]] std::string ToldOf() const { return Told(Read().status()); }
};

}  // namespace capfit::formats

#endif  // CAPFIT_TESTS_CORE_FORMATS_GLTF_MAKER_H_
