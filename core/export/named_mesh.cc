#include "core/export/named_mesh.h"

#include "absl/strings/str_format.h"
#include "core/export/gltf_document.h"
#include "core/export/gltf_preview.h"

namespace capfit::exports {
namespace {

std::string Word(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f') c = '_';
  }
  return text.empty() ? "mesh" : text;
}

}  // namespace

std::string ObjOf(std::span<const NamedMesh> meshes) {
  std::string text;
  std::size_t base = 1;
  for (const NamedMesh& mesh : meshes) {
    const std::string name = Word(mesh.name);
    absl::StrAppendFormat(&text, "o %s\ng %s\n", name, name);
    for (const Eigen::Vector3d& v : mesh.vertices) {
      absl::StrAppendFormat(&text, "v %.9g %.9g %.9g\n", v.x(), v.y(), v.z());
    }
    for (const std::array<std::uint32_t, 3>& t : mesh.triangles) {
      absl::StrAppendFormat(&text, "f %d %d %d\n", base + t[0], base + t[1], base + t[2]);
    }
    base += mesh.vertices.size();
  }
  return text;
}

absl::StatusOr<std::string> GlbOf(std::span<const NamedMesh> meshes) {
  GltfDocument document;
  GltfPreview writer(document);
  for (const NamedMesh& mesh : meshes) {
    const std::size_t index = writer.AddMesh(mesh.name, mesh.vertices, {}, mesh.triangles);
    document.AddNode({{"name", mesh.name}, {"mesh", index}}, std::nullopt);
  }
  return document.Bytes();
}

}  // namespace capfit::exports
