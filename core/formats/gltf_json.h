// The description in a glTF file, as far as meshes, skins and their places need it.
#ifndef CAPFIT_CORE_FORMATS_GLTF_JSON_H_
#define CAPFIT_CORE_FORMATS_GLTF_JSON_H_

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace capfit::formats {

// The object that the text describes, without images, materials, animations and extras, which may
// be large; nothing where it is no JSON object. O(text).
//
// Not json::parse with a callback: that searches the whole array again for each of its elements.
[[nodiscard]] std::optional<nlohmann::json> ParseGltfJson(std::string_view text);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_JSON_H_
