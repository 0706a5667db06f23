// Solids of the avatars: whole, and bodies to the room that comes after this one.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/body/find_body.h"
#include "core/formats/read_mesh.h"
#include "tests/core/solid/solid_shapes.h"
#include "tests/support/avatars.h"
#include "tests/support/bodies.h"

namespace capfit::solid {
namespace {

using nlohmann::json;

// The triangles of the parts whose "cover" is "yes", in metres; nothing where the file's order of
// parts is not that of the truth and the soup does not tell them apart.
std::optional<Triangles> Covered(const formats::PolygonSoup& soup, const json& truth) {
  std::vector<formats::SoupPart> parts = soup.parts;
  bool has_rigid = false;
  if (parts.empty()) {
    for (const json& part : truth["parts"]) {
      has_rigid = has_rigid || !part.value("skinned", true);
      const std::size_t first =
          parts.empty() ? 0 : parts.back().first_face + parts.back().face_count;
      parts.push_back({part["name"], "", first, part["faces"]});
    }
  }
  if (has_rigid) return std::nullopt;
  Triangles covered;
  for (const Eigen::Vector3d& p : soup.positions) {
    covered.positions.push_back(p * truth["metres_per_file_unit"].get<double>());
  }
  for (const json& part : truth["parts"]) {
    if (part["cover"] != "yes") continue;
    const auto found = std::find_if(parts.begin(), parts.end(), [&](const formats::SoupPart& p) {
      return p.face_count == part["faces"] && p.name == part["name"];
    });
    if (found == parts.end()) return std::nullopt;
    for (std::size_t f = found->first_face; f < found->first_face + found->face_count; ++f) {
      const std::uint32_t* const corners = soup.face_vertices.data() + 3 * f;
      covered.triangles.push_back({corners[0], corners[1], corners[2]});
    }
  }
  return covered;
}

// Distances of the landmarks from the joints, in mm, ascending.
std::vector<double> ErrorsMm(const body::Body& body, const json& joints) {
  std::vector<double> errors;
  for (const auto& [name, at] : joints.items()) {
    const auto id = body::LandmarkFromName(name);
    if (!id.has_value() || !body.landmark(*id).has_value()) continue;
    const Eigen::Vector3d found =
        body.body_from_caller.Inverse().Apply(body.landmark(*id)->position_m);
    errors.push_back(1000.0 * (found - Eigen::Vector3d(at[0], at[1], at[2])).norm());
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(AvatarSolidsTest, AreBodiesWithAllTheirLimbs) {
  CAPFIT_REQUIRE_AVATARS();
  const json truth =
      json::parse(test_support::ReadFile(test_support::AvatarsFolder() / "truth.json"));
  int looked_at = 0;
  for (const auto& [name, avatar] : truth.items()) {
    SCOPED_TRACE(name);
    const std::string bytes =
        test_support::ReadFile(test_support::AvatarsFolder() / (name + ".glb"));
    const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(soup.ok()) << soup.status();
    const std::optional<Triangles> covered = Covered(*soup, avatar);
    if (!covered.has_value()) continue;
    ++looked_at;
    const Solid solid = Made(*covered);
    EXPECT_GT(solid.mesh.volume(), 0.01);
    NullObserver observer;
    const auto body = body::FindBody(solid.mesh, {}, ThreadPool(1), observer);
    ASSERT_TRUE(body.ok()) << body.status();
    EXPECT_TRUE(body->warnings.empty()) << body->warnings.front().message;
    // A reader may give the bind pose or that of the nodes.
    std::vector<double> errors = ErrorsMm(*body, avatar["joints"]);
    if (avatar.contains("bind_joints")) {
      const std::vector<double> bind = ErrorsMm(*body, avatar["bind_joints"]);
      if (bind[bind.size() / 2] < errors[errors.size() / 2]) errors = bind;
    }
    ASSERT_GE(errors.size(), 13u);
    EXPECT_LE(errors[errors.size() / 2], 20.5);  // robot_like: 20.1
    EXPECT_LE(errors.back(), 60.0);
  }
  EXPECT_GE(looked_at, 10);
}

}  // namespace
}  // namespace capfit::solid
