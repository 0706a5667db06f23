#include "core/export/mesh_hulls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/status.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/gltf_extras.h"
#include "core/export/gltf_preview.h"
#include "core/export/lathe.h"
#include "core/export/named_mesh.h"
#include "core/export/solids.h"
#include "core/solid/make_solid.h"

namespace capfit::exports {
namespace {

constexpr int kMinSegments = 8;
constexpr int kMaxSegments = 256;
constexpr double kMinCellM = 0.002;
constexpr double kMaxCellM = 0.05;
// What the union is made from deviates by a tenth of a percent of the radius, which vertices then
// make up for.
constexpr int kUnionSegments = 64;
constexpr double kOnSurfaceM = 1e-6;
// One round brings faces out but for where the surface turns on the way; two leave hundredths of a
// millimetre.
constexpr int kLiftRounds = 2;

NamedMesh HullOf(const Solid& solid, int segments) {
  LatheMesh lathe = Lathe(solid, segments, LatheKind::kEnclosing);
  const Eigen::Isometry3d place = solid.Place();
  for (Eigen::Vector3d& vertex : lathe.vertices) vertex = (place * vertex).eval();
  return {solid.name, std::move(lathe.vertices), std::move(lathe.triangles)};
}

std::vector<NamedMesh> HullsOf(const ColliderSet& upright, int segments) {
  std::vector<NamedMesh> hulls;
  for (const Solid& solid : SolidsOf(upright)) hulls.push_back(HullOf(solid, segments));
  return hulls;
}

// The meshes of an upright set as files, the OBJ in the frame that was asked for.
absl::StatusOr<Exported> FilesOf(const ColliderSet& set, std::vector<NamedMesh> meshes,
                                 MeshFrame frame, const std::string& what) {
  Exported exported;
  CAPFIT_ASSIGN_OR_RETURN(std::string glb, GlbOf(meshes));
  Frame of_file = YUpFrame();
  if (frame == MeshFrame::kOfMesh) {
    const geometry::Similarity to_mesh = UprightFromMesh(set).Inverse();
    for (NamedMesh& mesh : meshes) {
      for (Eigen::Vector3d& vertex : mesh.vertices) vertex = to_mesh.Apply(vertex);
    }
    of_file = {"that of the mesh, in its unit", to_mesh.rotation, to_mesh.scale};
  }
  const std::string stem = FileStem(set) + "_" + what;
  const Statement statement =
      StatementOf(set, what, of_file, "closed meshes, faces counter-clockwise from outside");
  exported.files.push_back({stem + ".obj", StatementLines(statement, "# ", "") + ObjOf(meshes)});
  exported.files.push_back({stem + ".glb", std::move(glb)});
  return exported;
}

// The solid of a union that is nearest to a point, and how far its surface is.
struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  std::size_t solid = 0;
};

class UnionSurface {
 public:
  explicit UnionSurface(const std::vector<Solid>& solids) : solids_(solids) {}

  [[nodiscard]] Nearest At(const Eigen::Vector3d& point) const {
    Nearest nearest;
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      const double distance_m = solids_[s].hull.SignedDistance(point);
      if (distance_m < nearest.distance_m) nearest = {distance_m, s};
    }
    return nearest;
  }

  // The point brought to the surface along its normals; as it was where that is further than
  // `most_m` away.
  [[nodiscard]] Eigen::Vector3d Settled(const Eigen::Vector3d& point, double most_m) const {
    Eigen::Vector3d at = point;
    for (int step = 0; step < 20; ++step) {
      const Nearest nearest = At(at);
      if (std::abs(nearest.distance_m) <= kOnSurfaceM) return at;
      at -= nearest.distance_m * solids_[nearest.solid].hull.Locate(at).normal;
      if ((at - point).norm() > most_m) return point;
    }
    return at;
  }

  // The point moved away from the solid that it lies on.
  [[nodiscard]] Eigen::Vector3d Lifted(const Eigen::Vector3d& point, double by_m) const {
    return point + by_m * solids_[At(point).solid].hull.Locate(point).normal;
  }

 private:
  const std::vector<Solid>& solids_;
};

// Points of a face at which its depth is asked for: the middles of its edges and its own.
std::array<Eigen::Vector3d, 4> ProbesOf(const NamedMesh& mesh, const Corners& t) {
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  const Eigen::Vector3d& b = mesh.vertices[t[1]];
  const Eigen::Vector3d& c = mesh.vertices[t[2]];
  return {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0};
}

// Lifts each vertex by as much as the faces around it dip into the union.
void LiftFaces(const UnionSurface& surface, const ThreadPool& pool, NamedMesh& mesh) {
  std::vector<double> dips_m(mesh.triangles.size(), 0.0);
  pool.ForChunks(dips_m.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      for (const Eigen::Vector3d& probe : ProbesOf(mesh, mesh.triangles[f])) {
        dips_m[f] = std::max(dips_m[f], -surface.At(probe).distance_m);
      }
    }
  });
  std::vector<double> lifts_m(mesh.vertices.size(), 0.0);
  for (std::size_t f = 0; f < dips_m.size(); ++f) {
    for (const std::uint32_t corner : mesh.triangles[f]) {
      lifts_m[corner] = std::max(lifts_m[corner], dips_m[f]);
    }
  }
  pool.ForChunks(lifts_m.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (lifts_m[i] > 0.0) mesh.vertices[i] = surface.Lifted(mesh.vertices[i], lifts_m[i]);
    }
  });
}

struct Triangles {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<mesh::Triangle> triangles;
};

Triangles Joined(const std::vector<NamedMesh>& meshes) {
  Triangles all;
  for (const NamedMesh& mesh : meshes) {
    const auto base = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& t : mesh.triangles) {
      all.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
  }
  return all;
}

double AreaOf(const Triangles& all) {
  double area = 0.0;
  for (const mesh::Triangle& t : all.triangles) {
    const Eigen::Vector3d& a = all.vertices[t[0]];
    area += 0.5 * (all.vertices[t[1]] - a).cross(all.vertices[t[2]] - a).norm();
  }
  return area;
}

Warning DeviationWarning(const NamedMesh& mesh, const UnionSurface& surface) {
  double lowest_m = 0.0;
  double highest_m = 0.0;
  for (const Corners& t : mesh.triangles) {
    for (const Eigen::Vector3d& probe : ProbesOf(mesh, t)) {
      const double distance_m = surface.At(probe).distance_m;
      lowest_m = std::min(lowest_m, distance_m);
      highest_m = std::max(highest_m, distance_m);
    }
  }
  return {"UNION_DEVIATION",
          absl::StrFormat("the union's mesh has %d triangles, which lie up to %.2f mm inside and "
                          "%.2f mm outside of the union's surface",
                          mesh.triangles.size(), -1e3 * lowest_m, 1e3 * highest_m),
          static_cast<std::int64_t>(mesh.triangles.size())};
}

}  // namespace

absl::StatusOr<Exported> WriteHulls(const ColliderSet& set, const MeshOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  if (options.segments < kMinSegments || options.segments > kMaxSegments) {
    return OutOfRange("segments", options.segments, kMinSegments, kMaxSegments);
  }
  return FilesOf(set, HullsOf(Upright(set), options.segments), options.frame, "hulls");
}

absl::StatusOr<Exported> WriteUnion(const ColliderSet& set, const UnionOptions& options,
                                    const ThreadPool& pool) {
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  if (!(options.cell_m >= kMinCellM && options.cell_m <= kMaxCellM)) {
    return OutOfRange("cell_m", options.cell_m, kMinCellM, kMaxCellM);
  }
  const ColliderSet upright = Upright(set);
  const Triangles all = Joined(HullsOf(upright, kUnionSegments));
  solid::SolidOptions solid_options;
  solid_options.squares =
      static_cast<std::size_t>(std::max(1.0, AreaOf(all) / (options.cell_m * options.cell_m)));
  CAPFIT_ASSIGN_OR_RETURN(solid::Solid solid,
                          solid::MakeSolid(all.vertices, all.triangles, solid_options, pool));
  const std::vector<Solid> solids = SolidsOf(upright);
  const UnionSurface surface(solids);
  NamedMesh mesh{"body", {solid.mesh.vertices().begin(), solid.mesh.vertices().end()}, {}};
  for (const mesh::Triangle& t : solid.mesh.triangles())
    mesh.triangles.push_back({t[0], t[1], t[2]});
  pool.ForChunks(mesh.vertices.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      mesh.vertices[i] = surface.Settled(mesh.vertices[i], solid.cell);
    }
  });
  for (int round = 0; round < kLiftRounds; ++round) LiftFaces(surface, pool, mesh);
  const Warning deviation = DeviationWarning(mesh, surface);
  CAPFIT_ASSIGN_OR_RETURN(Exported exported, FilesOf(set, {mesh}, options.frame, "union"));
  exported.warnings = std::move(solid.warnings);
  exported.warnings.push_back(deviation);
  return exported;
}

}  // namespace capfit::exports
