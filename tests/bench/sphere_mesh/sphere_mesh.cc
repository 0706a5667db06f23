#include "tests/bench/sphere_mesh/sphere_mesh.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace capfit::bench {
namespace {

using geometry::Sphere;

constexpr int kMaxFan = 200;

Sphere Between(const Sphere& a, const Sphere& b, double t) {
  return {a.center_m + t * (b.center_m - a.center_m), a.radius_m + t * (b.radius_m - a.radius_m)};
}

// Two capsules d apart, of radius r where they are furthest apart, leave a furrow of d^2 / (8 r).
int FanSize(const Sphere& a, const Sphere& b, double sag) {
  const double length = (b.center_m - a.center_m).norm();
  const double radius = std::max(std::min(a.radius_m, b.radius_m), sag);
  return std::clamp(static_cast<int>(std::ceil(length / std::sqrt(8.0 * radius * sag))), 1,
                    kMaxFan);
}

}  // namespace

int PrimitiveCount(const SphereMesh& mesh) {
  return static_cast<int>(mesh.spheres.size() + mesh.edges.size() + 2 * mesh.triangles.size());
}

std::string ToJson(const SphereMesh& mesh, double seconds) {
  nlohmann::ordered_json json;
  json["spheres"] = nlohmann::ordered_json::array();
  for (const Sphere& sphere : mesh.spheres) {
    json["spheres"].push_back(
        {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m});
  }
  json["capsules"] = mesh.edges;
  json["triangles"] = mesh.triangles;
  json["n_p"] = PrimitiveCount(mesh);
  json["seconds"] = seconds;
  return json.dump() + "\n";
}

SphereMesh WithoutTriangles(const SphereMesh& mesh, double sag) {
  SphereMesh plain{mesh.spheres, mesh.edges, {}};
  for (const std::array<int, 3>& corners : mesh.triangles) {
    const Sphere a = mesh.spheres[corners[0]];
    const Sphere b = mesh.spheres[corners[1]];
    const int fan = FanSize(a, b, sag);
    for (int i = 1; i < fan; ++i) {
      plain.edges.push_back({corners[2], static_cast<int>(plain.spheres.size())});
      plain.spheres.push_back(Between(a, b, static_cast<double>(i) / fan));
    }
  }
  return plain;
}

}  // namespace capfit::bench
