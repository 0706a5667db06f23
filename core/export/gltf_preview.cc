#include "core/export/gltf_preview.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace capfit::exports {
namespace {

using nlohmann::json;

// glTF's numbers for what a view holds and what a number is.
constexpr int kVertices = 34962;
constexpr int kIndices = 34963;
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;

template <typename Number>
std::string_view BytesOf(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

}  // namespace

std::size_t GltfPreview::AddVectors(const std::vector<Eigen::Vector3d>& vectors, bool has_bounds) {
  std::vector<float> numbers;
  std::array<float, 3> low;
  std::array<float, 3> high;
  low.fill(std::numeric_limits<float>::max());
  high.fill(std::numeric_limits<float>::lowest());
  for (const Eigen::Vector3d& vector : vectors) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto number = static_cast<float>(vector[static_cast<Eigen::Index>(k)]);
      numbers.push_back(number);
      low[k] = std::min(low[k], number);
      high[k] = std::max(high[k], number);
    }
  }
  json accessor = {{"bufferView", document_.AddView(BytesOf(numbers), kVertices)},
                   {"componentType", kFloat},
                   {"count", vectors.size()},
                   {"type", "VEC3"}};
  if (has_bounds) {
    accessor["min"] = low;
    accessor["max"] = high;
  }
  return document_.Add("accessors", std::move(accessor));
}

template <typename Index>
std::size_t GltfPreview::AddIndices(const std::vector<Corners>& triangles, int component_type) {
  std::vector<Index> indices;
  for (const Corners& triangle : triangles) {
    for (const std::uint32_t corner : triangle) indices.push_back(static_cast<Index>(corner));
  }
  return document_.Add("accessors", {{"bufferView", document_.AddView(BytesOf(indices), kIndices)},
                                     {"componentType", component_type},
                                     {"count", indices.size()},
                                     {"type", "SCALAR"}});
}

std::size_t GltfPreview::Material() {
  if (material_.has_value()) return *material_;
  material_ = document_.Add("materials", {{"name", "capfit_preview"},
                                          {"alphaMode", "BLEND"},
                                          {"pbrMetallicRoughness",
                                           {{"baseColorFactor", {0.15, 0.45, 0.9, 0.35}},
                                            {"metallicFactor", 0.0},
                                            {"roughnessFactor", 0.8}}}});
  return *material_;
}

std::size_t GltfPreview::AddMesh(const std::string& name,
                                 const std::vector<Eigen::Vector3d>& vertices,
                                 const std::vector<Eigen::Vector3d>& normals,
                                 const std::vector<Corners>& triangles) {
  json attributes = {{"POSITION", AddVectors(vertices, true)}};
  if (!normals.empty()) attributes["NORMAL"] = AddVectors(normals, false);
  const std::size_t indices = vertices.size() <= std::numeric_limits<std::uint16_t>::max()
                                  ? AddIndices<std::uint16_t>(triangles, kUnsignedShort)
                                  : AddIndices<std::uint32_t>(triangles, kUnsignedInt);
  json primitive = {
      {"attributes", std::move(attributes)}, {"indices", indices}, {"material", Material()}};
  return document_.Add("meshes",
                       {{"name", name}, {"primitives", json::array({std::move(primitive)})}});
}

}  // namespace capfit::exports
