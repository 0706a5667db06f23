// A file of any bytes on its way to a body: parts, shells and solids.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "core/formats/read_mesh.h"
#include "core/pipeline/take_body.h"

namespace {

// A solid of many faces takes long under sanitizers.
constexpr std::size_t kMostFaces = 4000;

[[noreturn]] void Broken(const char* promise) {
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  capfit::formats::MeshLimits limits;
  limits.max_vertices = limits.max_faces = kMostFaces;
  const auto soup = capfit::formats::ReadMesh(std::as_bytes(std::span(data, size)),
                                              capfit::formats::MeshFormat::kGlb, limits);
  if (!soup.ok()) return 0;
  std::vector<capfit::Warning> warnings;
  capfit::NullObserver observer;
  const auto taken =
      capfit::pipeline::TakeBody(*soup, {}, capfit::ThreadPool(1), observer, warnings);
  if (!taken.ok()) return 0;
  const capfit::body::EnclosedSurface surface = taken->body.enclosed();
  if (surface.vertex_of_source.size() != soup->positions.size()) Broken("a source vertex is lost");
  if (surface.vertex_segments.size() != surface.vertices_m.size()) Broken("a segment is missing");
  for (const std::int32_t v : surface.vertex_of_source) {
    if (v < -1 || v >= static_cast<std::int64_t>(surface.vertices_m.size())) {
      Broken("vertex_of_source is wrong");
    }
  }
  return 0;
}
