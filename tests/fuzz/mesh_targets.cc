#include "tests/fuzz/mesh_targets.h"

#include <cstdint>

#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/mesh_promises.h"

namespace capfit::fuzz {
namespace {

constexpr int kFormats = 6;

std::string TryPrepare(const formats::PolygonSoup& soup, const formats::MeshLimits& limits,
                       bool is_file) {
  const auto prepared = mesh::PrepareMesh(soup, limits);
  return prepared.ok() ? BrokenPromiseOfPrepare(*prepared, soup.positions.size())
                       : BrokenPromiseOfRefusal(prepared.status(), is_file);
}

}  // namespace

formats::PolygonSoup SoupFrom(std::span<const std::byte> bytes) {
  ByteSource source(bytes);
  const std::uint8_t switches = source.Next();
  const bool has_polygons = (switches & 1) != 0;
  const bool may_be_out_of_range = (switches & 2) != 0;
  const double offset = (switches & 4) != 0 ? 1e6 : 0.0;
  const double scale = (switches & 8) != 0 ? 1e-6 : 1.0;  // below the tolerance of welding
  const unsigned vertices = 3 + source.Next() % 62u;
  formats::PolygonSoup soup;
  soup.is_from_file = (switches & 16) == 0;  // then faces of less than three corners are mended
  for (unsigned i = 0; i < vertices; ++i) {
    Eigen::Vector3d& position = soup.positions.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = source.NextSigned();
    }
    if (i % 2 == 1) position *= scale;
    position.array() += offset;
  }
  const unsigned indices = vertices + (may_be_out_of_range ? 1 : 0);
  while (!source.IsEmpty()) {
    const unsigned corners = has_polygons ? source.Next() % 9u : 3;
    for (unsigned k = 0; k < corners; ++k) soup.face_vertices.push_back(source.Next() % indices);
    if (has_polygons) soup.face_sizes.push_back(corners);
  }
  return soup;
}

std::string TryReadMesh(std::span<const std::byte> bytes) {
  if (bytes.empty()) return {};
  formats::MeshLimits limits;
  limits.max_vertices = 100'000;
  limits.max_faces = 100'000;
  const auto format = static_cast<formats::MeshFormat>(static_cast<unsigned>(bytes[0]) % kFormats);
  const auto soup = formats::ReadMesh(bytes.subspan(1), format, limits);
  return soup.ok() ? TryPrepare(*soup, limits, true) : BrokenPromiseOfRefusal(soup.status(), true);
}

std::string TryPrepareMesh(std::span<const std::byte> bytes) {
  return TryPrepare(SoupFrom(bytes), {}, false);
}

}  // namespace capfit::fuzz
