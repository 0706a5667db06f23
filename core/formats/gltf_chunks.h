// The pieces that a glTF 2.0 file (GLB, VRM, or JSON with its buffers inside) consists of.
#ifndef CAPFIT_CORE_FORMATS_GLTF_CHUNKS_H_
#define CAPFIT_CORE_FORMATS_GLTF_CHUNKS_H_

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::formats {

// Views of the file's bytes.
struct GltfChunks {
  std::string_view description;                    // JSON text
  std::span<const std::byte> binary;               // the first BIN chunk; empty where there is none
  std::vector<std::span<const std::byte>> others;  // chunks of other types, with their headers
};

// Whether the text begins as JSON does that describes a file (.gltf).
[[nodiscard]] bool LooksLikeGltfText(std::string_view text);

// Whether the bytes begin as a GLB does.
[[nodiscard]] bool LooksLikeGlb(std::span<const std::byte> bytes);

// Checks header and lengths of a GLB; a .gltf is all description. The description has at most 8 MB,
// strings of more than 1 kB not counted: it is to be parsed, which takes up to thirty times as
// much. INVALID_ARGUMENT says what is wrong.
[[nodiscard]] absl::StatusOr<GltfChunks> SplitGltf(std::span<const std::byte> bytes);

// What stands behind "data:TYPE;base64,"; nothing for other addresses.
[[nodiscard]] std::optional<std::string_view> Base64Of(std::string_view uri);

// A GLB of these chunks, padded as it must be; an empty binary chunk is left out.
// INVALID_ARGUMENT (TOO_LARGE) beyond the 4 GB that its header can tell.
[[nodiscard]] absl::StatusOr<std::string> JoinGltf(const GltfChunks& chunks);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_CHUNKS_H_
