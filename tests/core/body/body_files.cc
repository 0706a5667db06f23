#include "tests/core/body/body_files.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/support/bodies.h"

namespace capfit::body {

std::vector<PosedBody> PosedBodies() {
  std::vector<PosedBody> bodies;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(test_support::BodiesFolder())) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".truth.json") && name.find("no_hands") == std::string::npos) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const nlohmann::json truth = nlohmann::json::parse(test_support::ReadFile(file));
    for (const auto& [pose, data] : truth["poses"].items()) {
      PosedBody body;
      body.file = data["file"].get<std::string>();
      for (const auto& [name, p] : data["joints"].items()) {
        body.points[name] = Eigen::Vector3d(p[0], p[1], p[2]);
      }
      for (const auto& [name, entry] : data["surface_points"].items()) {
        const auto& p = entry["position"];
        body.points[name] = Eigen::Vector3d(p[0], p[1], p[2]);
      }
      bodies.push_back(std::move(body));
    }
  }
  return bodies;
}

mesh::BodyMesh LoadBody(const std::string& file) {
  const std::string bytes = test_support::ReadFile(test_support::BodiesFolder() / file);
  const auto soup =
      formats::ReadMesh({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()},
                        formats::FormatFromFileName(file));
  EXPECT_TRUE(soup.ok()) << file << ": " << soup.status();
  auto prepared = mesh::PrepareMesh(*soup);
  EXPECT_TRUE(prepared.ok()) << file << ": " << prepared.status();
  return std::move(prepared->mesh);
}

absl::StatusOr<Body> Find(const mesh::BodyMesh& mesh, const BodyOptions& options) {
  return FindBody(mesh, options, ThreadPool(1), NullObserver());
}

double ErrorMm(const Body& body, const std::string& name, const Eigen::Vector3d& truth) {
  const auto id = LandmarkFromName(name);
  if (!id || !body.landmark(*id)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d found =
      body.body_from_caller.Inverse().Apply(body.landmark(*id)->position_m);
  return 1000.0 * (found - truth).norm();
}

double LabelledRight(const Body& body, const std::string& label_file) {
  return LabelledAs(body, test_support::ReadFile(test_support::BodiesFolder() / label_file));
}

double LabelledAs(const Body& body, const std::string& labels) {
  const auto sources = body.mesh.vertex_of_source();
  EXPECT_EQ(labels.size(), sources.size());
  std::vector<int> label(body.mesh.vertices().size(), -1);
  for (std::size_t i = 0; i < sources.size() && i < labels.size(); ++i) {
    if (sources[i] >= 0) label[sources[i]] = labels[i];
  }
  double right = 0.0;
  double total = 0.0;
  const auto points = body.mesh.vertices();
  for (const mesh::Triangle& t : body.mesh.triangles()) {
    const double area = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
    for (const std::uint32_t v : t) {
      total += area;
      if (label[v] == static_cast<int>(body.vertex_segments[v])) right += area;
    }
  }
  return right / total;
}

bool IsMainJoint(const std::string& name) {
  for (const char* const joint : {"wrist", "elbow", "knee", "ankle"}) {
    if (name.ends_with(joint)) return true;
  }
  return name == "crotch" || name == "neck";
}

bool IsShoulderOrHip(const std::string& name) {
  return name.ends_with("_shoulder") || name.ends_with("_hip");
}

}  // namespace capfit::body
