#include "server/result_bytes.h"

#include <algorithm>
#include <cstddef>

namespace capfit::server {
namespace {

constexpr std::int64_t kSmallParts = 256LL * 1024;
// Where the budget is an error, which hardly any body meets with more.
constexpr int kSpheresOfAnError = 128;
// With sparse weights a sphere has some 100 vertices, each of a weight and a step to it.
constexpr std::int64_t kSparseBytesOfASphere = 1024;
constexpr std::int64_t kFloatBytes = sizeof(float);

std::int64_t ExpectedSpheres(const pipeline::FitOptions& options) {
  if (options.polygon_error) return kSpheresOfAnError;
  if (options.layout) return static_cast<std::int64_t>(options.layout->spheres.size());
  if (options.max_spheres) return *options.max_spheres;
  return options.max_primitives.value_or(pipeline::kDefaultMaxPrimitives);
}

template <typename Container>
std::int64_t BytesOf(const Container& container) {
  return static_cast<std::int64_t>(container.size() * sizeof(container[0]));
}

}  // namespace

std::int64_t ResultBytes(const pipeline::FitResult& result) {
  std::int64_t bytes = kSmallParts + BytesOf(result.vertex_gaps);
  if (result.weights) bytes += BytesOf(result.weights->weights);
  if (result.sparse_weights || result.bone_weights) {
    bytes += kSparseBytesOfASphere * static_cast<std::int64_t>(result.primitives.spheres.size());
  }
  for (const pipeline::ExportedFile& file : result.exports) bytes += BytesOf(file.file.bytes);
  for (const pipeline::PolygonResult& polygon : result.polygons) {
    bytes += BytesOf(polygon.outline) + BytesOf(polygon.circles);
  }
  return bytes;
}

std::int64_t ExpectedResultBytes(const pipeline::FitOptions& options, std::int64_t vertices,
                                 std::int64_t mesh_bytes) {
  std::int64_t bytes = kSmallParts;
  const std::int64_t spheres = ExpectedSpheres(options);
  if (options.skinning == pipeline::SkinningMode::kDense) bytes += kFloatBytes * spheres * vertices;
  if (options.want_vertex_gaps) bytes += kFloatBytes * vertices;
  for (const pipeline::ExportWish& wish : options.exports) {
    // Files that give the caller's own back are as large; the others are small.
    const exports::ExportFormat* const format = exports::FindExportFormat(wish.format);
    bytes +=
        format != nullptr && format->needs_original ? mesh_bytes + kSmallParts : 4 * kSmallParts;
  }
  return bytes;
}

}  // namespace capfit::server
