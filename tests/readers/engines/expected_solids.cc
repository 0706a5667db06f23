#include "tests/readers/engines/expected_solids.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>

namespace capfit::readers {
namespace {

using nlohmann::json;

Eigen::Vector3d PointOf(const json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

geometry::Sphere SphereOf(const json& root, const json& sphere) {
  const json& rows = root.at("upright_from_mesh");
  const Eigen::Vector3d center = PointOf(sphere.at("center"));
  Eigen::Vector3d upright;
  for (int row = 0; row < 3; ++row) {
    const json& numbers = rows.at(static_cast<std::size_t>(row));
    upright[row] = PointOf(numbers).dot(center) + numbers.at(3).get<double>();
  }
  return {upright, root.at("metres_per_unit").get<double>() * sphere.at("radius").get<double>()};
}

}  // namespace

std::vector<ExpectedSolid> ExpectedSolids(const std::string& folder) {
  const json root = FileJson(folder + "/expected.json");
  const json& spheres = root.at("spheres");
  const auto name = [&](std::size_t i) { return spheres.at(i).at("name").get<std::string>(); };
  std::vector<ExpectedSolid> solids;
  for (const json& capsule : root.at("capsules")) {
    const std::size_t a = capsule.at("spheres").at(0).get<std::size_t>();
    const std::size_t b = capsule.at("spheres").at(1).get<std::size_t>();
    solids.push_back({capsule.at("name").get<std::string>(),
                      {name(a), name(b)},
                      {SphereOf(root, spheres.at(a)), SphereOf(root, spheres.at(b))}});
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (!spheres.at(i).at("lone").get<bool>()) continue;
    const geometry::Sphere sphere = SphereOf(root, spheres.at(i));
    solids.push_back({name(i), {name(i)}, {sphere, sphere}});
  }
  return solids;
}

std::string FileText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path.c_str());
    std::exit(2);
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

json FileJson(const std::string& path) { return json::parse(FileText(path)); }

std::vector<Eigen::Vector3d> Directions(int count) {
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < count; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double across = std::sqrt(1.0 - y * y);
    directions.emplace_back(across * std::cos(angle), y, across * std::sin(angle));
  }
  return directions;
}

std::vector<Eigen::Vector3d> SurfacePoints(const geometry::TaperedCapsule& hull, int count) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& direction : Directions(count)) {
    for (const double t : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      const Eigen::Vector3d center = (1.0 - t) * hull.a().center_m + t * hull.b().center_m;
      const double radius_m = (1.0 - t) * hull.a().radius_m + t * hull.b().radius_m;
      const Eigen::Vector3d point = center + radius_m * direction;
      if (hull.SignedDistance(point) > -1e-9) points.push_back(point);
    }
  }
  return points;
}

void Failures::Check(bool is_so, const std::string& message) {
  if (is_so) return;
  if (++count_ <= 20) std::fprintf(stderr, "FAILED: %s\n", message.c_str());
}

void Failures::Near(double value, double expected, double tolerance, const std::string& message) {
  Check(std::abs(value - expected) <= tolerance,
        message + ": " + std::to_string(value) + " for " + std::to_string(expected));
}

int Failures::Finish(const std::string& message) const {
  if (count_ == 0) std::printf("ok: %s\n", message.c_str());
  if (count_ > 0) std::printf("%d failures: %s\n", count_, message.c_str());
  return count_ == 0 ? 0 : 1;
}

}  // namespace capfit::readers
