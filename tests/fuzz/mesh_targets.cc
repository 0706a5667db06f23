#include "tests/fuzz/mesh_targets.h"

#include <cmath>
#include <cstdint>

#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/mesh_promises.h"

namespace capfit::fuzz {
namespace {

constexpr int kFormats = 6;

bool IsInfluence(const formats::JointInfluences& influences, std::size_t joints) {
  double sum = 0.0;
  for (std::size_t k = 0; k < influences.weight.size(); ++k) {
    if (!(influences.weight[k] >= 0.0F)) return false;
    if (influences.weight[k] > 0.0F && influences.joint[k] >= joints) return false;
    sum += influences.weight[k];
  }
  return sum == 0.0 || std::abs(sum - 1.0) < 1e-5;
}

// What polygon_soup.h says of joints, influences and parts.
std::string BrokenPromiseOfRig(const formats::PolygonSoup& soup) {
  const auto joints = static_cast<std::int64_t>(soup.joints.size());
  for (const formats::NamedJoint& joint : soup.joints) {
    if (!joint.position.allFinite()) return "a joint stands nowhere";
    if (joint.parent < -1 || joint.parent >= joints) return "a joint has no such parent";
  }
  std::size_t next_face = 0;
  for (const formats::SoupPart& part : soup.parts) {
    if (part.first_face != next_face) return "parts do not follow each other";
    if (part.joint < -1 || part.joint >= joints) return "a part hangs under no such joint";
    next_face += part.face_count;
  }
  if (!soup.parts.empty() && next_face != soup.face_count()) return "parts lack faces";
  if (soup.influences.empty()) return {};
  if (soup.influences.size() != soup.positions.size()) return "not all vertices have influences";
  for (const formats::JointInfluences& influences : soup.influences) {
    if (!IsInfluence(influences, soup.joints.size())) return "influences are none";
  }
  return {};
}

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
  if (!soup.ok()) return BrokenPromiseOfRefusal(soup.status(), true);
  const std::string broken = BrokenPromiseOfRig(*soup);
  return broken.empty() ? TryPrepare(*soup, limits, true) : broken;
}

std::string TryPrepareMesh(std::span<const std::byte> bytes) {
  return TryPrepare(SoupFrom(bytes), {}, false);
}

}  // namespace capfit::fuzz
