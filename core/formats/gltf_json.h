// The description in a glTF file, as far as meshes, skins and their places need it, and its values.
#ifndef CAPFIT_CORE_FORMATS_GLTF_JSON_H_
#define CAPFIT_CORE_FORMATS_GLTF_JSON_H_

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "core/formats/file_error.h"

namespace capfit::formats {

// What a file is read for.
enum class GltfContent : std::uint8_t { kStill, kAnimated };

// The object that the text describes, without images and extras, which may be large, without
// animations unless they are what the file is read for, of materials only the names, of the file's
// own extensions only VRM's table of human bones; nothing where it is no JSON object. O(text).
//
// Not json::parse with a callback: that searches the whole array again for each of its elements.
[[nodiscard]] std::optional<nlohmann::json> ParseGltfJson(
    std::string_view text, GltfContent content = GltfContent::kStill);

// json[key], or null where it is absent or `json` is no object.
[[nodiscard]] const nlohmann::json& ValueAt(const nlohmann::json& json, const char* key);

// json[key] as an array; an empty one where it is absent or no array.
[[nodiscard]] const nlohmann::json& ArrayAt(const nlohmann::json& json, const char* key);

// json[key] as an index below `limit`; nothing where it is absent or anything else.
[[nodiscard]] std::optional<std::size_t> IndexAt(const nlohmann::json& json, const char* key,
                                                 std::size_t limit);

// Why IndexAt() gives nothing where there must be an index.
[[nodiscard]] absl::Status BadIndexAt(const FilePlace& place, const nlohmann::json& json,
                                      const char* key, std::size_t limit);

// Those of json[key] that are indices below `limit`.
[[nodiscard]] std::vector<std::size_t> IndicesAt(const nlohmann::json& json, const char* key,
                                                 std::size_t limit);

// No size in a file can exceed that of the largest file that fits in memory.
inline constexpr std::size_t kMostFileBytes = std::size_t{1} << 48;

// json[key] as a number of bytes, up to that; `fallback` where it is absent, nothing where it is
// anything else.
[[nodiscard]] std::optional<std::size_t> SizeAt(const nlohmann::json& json, const char* key,
                                                std::size_t fallback);

// json[key] as a text of up to 256 bytes; empty where it is absent, anything else or longer, for
// then it names nothing.
[[nodiscard]] std::string NameAt(const nlohmann::json& json, const char* key);

// json.extensions[name], or null.
[[nodiscard]] const nlohmann::json& ExtensionAt(const nlohmann::json& json, const char* name);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_JSON_H_
