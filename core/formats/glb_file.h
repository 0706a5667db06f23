// The container of a binary glTF file and the arrays (accessors) in it.
#ifndef CAPFIT_CORE_FORMATS_GLB_FILE_H_
#define CAPFIT_CORE_FORMATS_GLB_FILE_H_

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "core/formats/file_error.h"

namespace capfit::formats {

// The JSON chunk and the bytes of the binary chunk (a view of the caller's).
struct GlbFile {
  nlohmann::json json;
  std::span<const std::byte> binary;
};

// Checks the header and the lengths of the chunks, and parses the JSON. INVALID_ARGUMENT says
// what is wrong.
[[nodiscard]] absl::StatusOr<GlbFile> OpenGlb(std::span<const std::byte> bytes);

// json[key] as an index below `limit`; nothing where it is absent or anything else.
[[nodiscard]] std::optional<std::size_t> IndexAt(const nlohmann::json& json, const char* key,
                                                 std::size_t limit);

// Why IndexAt() gives nothing where there must be an index.
[[nodiscard]] absl::Status BadIndexAt(const FilePlace& place, const nlohmann::json& json,
                                      const char* key, std::size_t limit);

// json[key] as an array; an empty one where it is absent or no array.
[[nodiscard]] const nlohmann::json& ArrayAt(const nlohmann::json& json, const char* key);

// One accessor: `count` elements of `components` numbers each, all inside the binary chunk.
class GltfAccessor {
 public:
  // `type` is "SCALAR", "VEC3" or "MAT4". Sparse accessors, compressed buffer views and buffers
  // outside the file are refused.
  [[nodiscard]] static absl::StatusOr<GltfAccessor> Create(const GlbFile& file, std::size_t index,
                                                           const std::string& type);

  [[nodiscard]] std::size_t count() const { return count_; }
  // Whether the numbers are unsigned integers, as indices must be.
  [[nodiscard]] bool IsUnsigned() const;
  // One number of one element, both in range; integers are scaled to [-1, 1] if the accessor says
  // so.
  [[nodiscard]] double At(std::size_t element, std::size_t component) const;

 private:
  GltfAccessor() = default;
  absl::Status FindBytes(const GlbFile& file, const nlohmann::json& accessor,
                         const FilePlace& place);

  std::span<const std::byte> bytes_;
  std::size_t count_ = 0;
  std::size_t components_ = 1;
  std::size_t stride_ = 0;
  int component_type_ = 0;
  bool normalized_ = false;
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLB_FILE_H_
