// The arrays (accessors) of a glTF file.
#ifndef CAPFIT_CORE_FORMATS_GLTF_ACCESSOR_H_
#define CAPFIT_CORE_FORMATS_GLTF_ACCESSOR_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_file.h"

namespace capfit::formats {

// `componentType` of an accessor.
enum class GltfComponent : std::uint16_t {
  kInt8 = 5120,
  kUint8 = 5121,
  kInt16 = 5122,
  kUint16 = 5123,
  kUint32 = 5125,
  kFloat32 = 5126
};

// `count` elements of `components` numbers each, all of which are there: in a buffer view of the
// file, which must outlive it, or in bytes of its own (sparse ones; what was decoded).
class GltfAccessor {
 public:
  // `type` is "SCALAR", "VEC3", "VEC4" or "MAT4". Without a buffer view all numbers are zero.
  [[nodiscard]] static absl::StatusOr<GltfAccessor> Create(GltfFile& file, std::size_t index,
                                                           const std::string& type);

  // Numbers that follow each other without gaps: the size of `bytes` is that of all elements.
  [[nodiscard]] static GltfAccessor FromBytes(std::vector<std::byte> bytes, std::size_t components,
                                              GltfComponent type, bool normalized);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t components() const { return components_; }
  // The same with integers scaled, or not.
  [[nodiscard]] GltfAccessor WithNormalized(bool normalized) const {
    GltfAccessor result = *this;
    result.normalized_ = normalized;
    return result;
  }
  // Whether the numbers are unsigned integers, as indices must be.
  [[nodiscard]] bool IsUnsigned() const;
  // One number of one element, both in range; integers are scaled to [-1, 1] if the accessor says
  // so.
  [[nodiscard]] double At(std::size_t element, std::size_t component) const;
  // The first three numbers of an element.
  [[nodiscard]] Eigen::Vector3d VectorAt(std::size_t element) const;

 private:
  GltfAccessor() = default;
  absl::Status ReadLayout(const nlohmann::json& accessor, const FilePlace& place);
  absl::Status FindBytes(GltfFile& file, const nlohmann::json& accessor, const FilePlace& place);
  absl::Status ReplaceSparse(GltfFile& file, const nlohmann::json& sparse, const FilePlace& place);
  [[nodiscard]] std::size_t element_size() const;

  std::span<const std::byte> bytes_;
  std::shared_ptr<std::vector<std::byte>> own_;  // what bytes_ shows, where they are not the file's
  std::size_t count_ = 0;
  std::size_t components_ = 1;
  std::size_t stride_ = 0;
  GltfComponent type_ = GltfComponent::kFloat32;
  bool normalized_ = false;
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_ACCESSOR_H_
