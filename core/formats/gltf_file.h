// The container of a glTF 2.0 file (GLB, VRM, or JSON with its buffers inside) and its buffer
// views.
#ifndef CAPFIT_CORE_FORMATS_GLTF_FILE_H_
#define CAPFIT_CORE_FORMATS_GLTF_FILE_H_

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_json.h"

namespace capfit::formats {

// Whether the text begins as JSON does that describes a file (.gltf).
[[nodiscard]] bool LooksLikeGltfText(std::string_view text);

class GltfFile {
 public:
  // Checks the header and the lengths of the chunks, parses the JSON, and unpacks buffers that are
  // written in it as base64. INVALID_ARGUMENT says what is wrong; an extension that the file calls
  // required and that changes its geometry in a way not read here is refused by name
  // (UNSUPPORTED_FILE). Keeps a view of `bytes`.
  [[nodiscard]] static absl::StatusOr<GltfFile> Open(std::span<const std::byte> bytes,
                                                     GltfContent content = GltfContent::kStill);

  GltfFile(GltfFile&&) = default;
  GltfFile& operator=(GltfFile&&) = default;

  [[nodiscard]] const nlohmann::json& description() const { return json_; }

  // The bytes of a buffer view, unpacked where EXT_meshopt_compression packed them (once: the file
  // keeps them). Buffers in other files are refused. They stay where they are as long as the file.
  [[nodiscard]] absl::StatusOr<std::span<const std::byte>> View(std::size_t index);

  // Claims memory for what is unpacked from this file: 256 MB for all of it, which is several times
  // what the largest mesh takes. Few bytes may ask for much.
  [[nodiscard]] absl::Status Claim(std::size_t bytes, const FilePlace& place);

 private:
  GltfFile() = default;
  absl::Status OpenChunks(std::span<const std::byte> bytes, GltfContent content);
  absl::Status OpenText(std::span<const std::byte> bytes, GltfContent content);
  absl::Status UnpackBuffers();
  [[nodiscard]] absl::StatusOr<std::span<const std::byte>> Range(const nlohmann::json& view,
                                                                 const FilePlace& place) const;

  nlohmann::json json_;
  std::span<const std::byte> binary_;
  std::vector<std::optional<std::string>> unpacked_buffers_;  // from base64, in the file's order
  std::map<std::size_t, std::vector<std::byte>> unpacked_views_;
  std::size_t claimed_bytes_ = 0;
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_FILE_H_
