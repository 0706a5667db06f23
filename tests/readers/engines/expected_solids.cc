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

// `place`: of its centre, in the mesh's frame.
geometry::Sphere SphereOf(const json& root, const json& sphere, const json& place) {
  const json& rows = root.at("upright_from_mesh");
  const Eigen::Vector3d center = PointOf(place);
  Eigen::Vector3d upright;
  for (int row = 0; row < 3; ++row) {
    const json& numbers = rows.at(static_cast<std::size_t>(row));
    upright[row] = PointOf(numbers).dot(center) + numbers.at(3).get<double>();
  }
  return {upright, root.at("metres_per_unit").get<double>() * sphere.at("radius").get<double>()};
}

}  // namespace

std::vector<ExpectedSolid> ExpectedSolids(const std::string& folder, When when) {
  const bool is_posed = when == When::kPosed;
  const json root = FileJson(folder + "/expected.json");
  const json& spheres = root.at("spheres");
  const auto name = [&](std::size_t i) { return spheres.at(i).at("name").get<std::string>(); };
  std::vector<ExpectedSolid> solids;
  for (const json& capsule : root.at("capsules")) {
    const auto end = [&](std::size_t k) {
      const json& sphere = spheres.at(capsule.at("spheres").at(k).get<std::size_t>());
      const json& place = is_posed ? capsule.at("posed_centers").at(k) : sphere.at("center");
      return SphereOf(root, sphere, place);
    };
    solids.push_back({capsule.at("name").get<std::string>(),
                      {name(capsule.at("spheres").at(0).get<std::size_t>()),
                       name(capsule.at("spheres").at(1).get<std::size_t>())},
                      {end(0), end(1)},
                      capsule.at("joint").get<int>()});
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const json& lone = spheres.at(i);
    if (!lone.at("lone").get<bool>()) continue;
    const geometry::Sphere sphere =
        SphereOf(root, lone, lone.at(is_posed ? "posed_center" : "center"));
    solids.push_back({name(i), {name(i)}, {sphere, sphere}, lone.at("joint").get<int>()});
  }
  return solids;
}

JointMoves::JointMoves(const std::string& folder, When when) {
  const json root = FileJson(folder + "/expected.json");
  for (const json& joint : root.at("joints")) {
    Eigen::Isometry3d& moves = moves_.emplace_back(Eigen::Isometry3d::Identity());
    if (when == When::kAtRest) continue;
    const json& moved = joint.at("moved_upright");
    const json& q = moved.at("rotation");
    moves = Eigen::Translation3d(PointOf(moved.at("position"))) *
            Eigen::Quaterniond(q.at(3).get<double>(), q.at(0).get<double>(), q.at(1).get<double>(),
                               q.at(2).get<double>());
  }
}

Eigen::Isometry3d JointMoves::Of(int joint) const {
  return joint < 0 ? Eigen::Isometry3d::Identity() : moves_.at(static_cast<std::size_t>(joint));
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
