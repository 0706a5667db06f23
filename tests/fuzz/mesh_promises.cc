#include "tests/fuzz/mesh_promises.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/mesh/triangulate_faces.h"

namespace capfit::fuzz {
namespace {

using mesh::BodyMesh;
using mesh::Triangle;

std::string BrokenByTriangles(const BodyMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;  // of each directed edge
  for (const Triangle& t : mesh.triangles()) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] >= mesh.vertices().size()) return "a corner is out of range";
      if (t[k] == t[(k + 1) % 3]) return "a triangle has two equal corners";
      ++runs[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : runs) {
    if (count != 1) return "an edge is run twice the same way";
    if (runs.count({edge.second, edge.first}) != 1) return "an edge has one triangle only";
  }
  if (mesh.mates().size() != 3 * mesh.triangles().size()) return "mates have a wrong size";
  for (mesh::HalfEdge h = 0; h < mesh.mates().size(); ++h) {
    const mesh::HalfEdge mate = mesh.mates()[h];
    if (mate >= mesh.mates().size() ||
        mesh::StartOf(mesh.triangles(), mate) != mesh::EndOf(mesh.triangles(), h) ||
        mesh::EndOf(mesh.triangles(), mate) != mesh::StartOf(mesh.triangles(), h)) {
      return "a half-edge has a wrong mate";
    }
  }
  return {};
}

std::string BrokenByVertices(const BodyMesh& mesh, std::size_t source_vertices) {
  std::vector<bool> used(mesh.vertices().size(), false);
  for (const Triangle& t : mesh.triangles()) used[t[0]] = used[t[1]] = used[t[2]] = true;
  if (std::find(used.begin(), used.end(), false) != used.end()) return "a vertex is unused";
  for (const Eigen::Vector3d& v : mesh.vertices()) {
    if (!v.allFinite()) return "a coordinate is not finite";
  }
  if (mesh.vertex_of_source().size() != source_vertices) return "vertex_of_source has a wrong size";
  for (const std::int32_t v : mesh.vertex_of_source()) {
    if (v < -1 || v >= static_cast<std::int64_t>(used.size())) return "vertex_of_source is wrong";
  }
  return {};
}

// From the lowest corner on.
Triangle Turned(const Triangle& t) {
  Triangle turned = t;
  std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
  return turned;
}

}  // namespace

bool IsReordered(const formats::PolygonSoup& soup, const BodyMesh& mesh) {
  const auto place = mesh.vertex_of_source();
  if (mesh.vertices().size() != soup.positions.size() || place.size() != soup.positions.size()) {
    return false;
  }
  std::vector<Triangle> came;
  for (Triangle t : mesh::FacesAsTriangles(soup)) {
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(place[v]);
    came.push_back(Turned(t));
  }
  std::vector<Triangle> here;
  for (const Triangle& t : mesh.triangles()) here.push_back(Turned(t));
  std::sort(came.begin(), came.end());
  std::sort(here.begin(), here.end());
  if (came != here) return false;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (mesh.vertices()[place[i]] != soup.positions[i]) return false;
  }
  return true;
}

std::string BrokenPromise(const BodyMesh& mesh, std::size_t source_vertices) {
  if (mesh.triangles().empty()) return "the mesh is empty";
  if (std::string broken = BrokenByTriangles(mesh); !broken.empty()) return broken;
  if (std::string broken = BrokenByVertices(mesh, source_vertices); !broken.empty()) return broken;
  if (!(mesh.volume() > 0.0)) return "the volume is not positive";
  return {};
}

std::string BrokenPromiseOfPrepare(const mesh::PreparedMesh& prepared,
                                   std::size_t source_vertices) {
  const BodyMesh& mesh = prepared.mesh;
  if (std::string broken = BrokenPromise(mesh, source_vertices); !broken.empty()) return broken;
  formats::PolygonSoup soup;
  soup.positions.assign(mesh.vertices().begin(), mesh.vertices().end());
  for (const Triangle& t : mesh.triangles()) {
    soup.face_vertices.insert(soup.face_vertices.end(), t.begin(), t.end());
  }
  formats::MeshLimits limits;
  limits.max_faces = soup.face_vertices.size();
  const auto again = mesh::PrepareMesh(soup, limits);
  if (!again.ok()) return "a prepared mesh is refused: " + again.status().ToString();
  if (!again->warnings.empty()) {
    return "a prepared mesh gets the warning " + again->warnings.front().code;
  }
  return IsReordered(soup, again->mesh) ? std::string() : "a prepared mesh is changed";
}

std::string BrokenPromiseOfRefusal(const absl::Status& refusal, bool is_file) {
  const auto reason = ReasonOf(refusal);
  if (!reason) return "a refusal has no reason: " + refusal.ToString();
  if (ErrorReasons()[Index(*reason)].code != refusal.code()) {
    return "a refusal's code is not that of its reason: " + refusal.ToString();
  }
  if (refusal.message().empty()) return "a refusal has no message";
  if (refusal.code() != absl::StatusCode::kInvalidArgument) return {};
  const std::string field = FieldOf(refusal).value_or("");
  if (field.empty() || (is_file && field != "mesh.file")) {
    return "a refusal names the field '" + field + "': " + refusal.ToString();
  }
  return {};
}

}  // namespace capfit::fuzz
