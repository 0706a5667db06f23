// Buffer views that EXT_meshopt_compression packed.
#ifndef CAPFIT_CORE_FORMATS_GLTF_MESHOPT_H_
#define CAPFIT_CORE_FORMATS_GLTF_MESHOPT_H_

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/file_error.h"

namespace capfit::formats {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

enum class MeshoptMode { kAttributes, kTriangles, kIndices };
enum class MeshoptFilter { kNone, kOctahedral, kQuaternion, kExponential };

// What the unpacked bytes are: `count` elements of `stride` bytes.
struct MeshoptLayout {
  MeshoptMode mode = MeshoptMode::kAttributes;
  MeshoptFilter filter = MeshoptFilter::kNone;
  std::size_t count = 0;
  std::size_t stride = 0;

  [[nodiscard]] std::size_t size() const { return count * stride; }
};

// From the extension's object. Refused where it is none that the decoder takes, or claims more than
// `packed_bytes` can hold (64 to 1, by the codec).
[[nodiscard]] absl::StatusOr<MeshoptLayout> ReadMeshoptLayout(const nlohmann::json& extension,
                                                              std::size_t packed_bytes,
                                                              const FilePlace& place);

// The unpacked bytes, layout.size() of them. Any bytes give an error or that. Indices may be
// anything.
[[nodiscard]] absl::StatusOr<std::vector<std::byte>> DecodeMeshopt(
    const MeshoptLayout& layout, std::span<const std::byte> packed, const FilePlace& place);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_MESHOPT_H_
