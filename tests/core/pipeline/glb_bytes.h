// Binary files put together in memory.
#ifndef CAPFIT_TESTS_CORE_PIPELINE_GLB_BYTES_H_
#define CAPFIT_TESTS_CORE_PIPELINE_GLB_BYTES_H_

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace capfit::pipeline {

template <typename Value>
void AppendValue(Value value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A GLB of that JSON and that binary chunk, whose size is a multiple of four.
inline std::string GlbBytes(const nlohmann::json& gltf, const std::string& binary) {
  std::string text = gltf.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  AppendValue<std::uint32_t>(2, bytes);
  AppendValue(static_cast<std::uint32_t>(28 + text.size() + binary.size()), bytes);
  AppendValue(static_cast<std::uint32_t>(text.size()), bytes);
  bytes += "JSON" + text;
  AppendValue(static_cast<std::uint32_t>(binary.size()), bytes);
  return bytes + std::string("BIN\0", 4) + binary;
}

}  // namespace capfit::pipeline

#endif  // CAPFIT_TESTS_CORE_PIPELINE_GLB_BYTES_H_
