#include "client/picture/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "client/picture/result_set.h"
#include "core/mannequin/mannequin.h"

namespace capfit::client {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kPi = std::numbers::pi;

Figure OneSphere(const Vector3d& center, double radius) {
  Figure figure;
  const geometry::Sphere sphere{center, radius};
  figure.solids.emplace_back(sphere, sphere);
  figure.solid_colors.push_back(PartColor("torso", 0.5));
  return figure;
}

// A small body with one capsule along its trunk.
struct Scene {
  mesh::PolygonSoup soup;
  ResultSet result;
  Figure figure;
};

Scene SmallScene() {
  Scene scene;
  mannequin::MannequinOptions options;
  options.faces = 2'000;
  scene.soup = *mannequin::MakeMannequin(options);
  scene.result =
      *ParseResultSet(R"({"spheres": [[0, 0.9, 0, 0.16], [0, 1.3, 0, 0.15], [0, 1.6, 0, 0.1]],
                          "capsules": [[0, 1]], "sphere_parts": ["torso", "torso", "head"],
                          "metrics": {"primitive_count": 4, "volume_error": 0.5, "note": "text"}})");
  std::vector<Vector3d> centers;
  for (const geometry::Sphere& sphere : scene.result.spheres) centers.push_back(sphere.center_m);
  scene.figure = MakeFigure(scene.soup, scene.result, scene.soup.positions, centers,
                            TurnUpright(scene.soup.positions, scene.result, PictureUp::kAuto));
  return scene;
}

double Darkness(const Pixels& pixels) {
  double sum = 0.0;
  for (const std::uint32_t pixel : pixels.argb) sum += (pixel & 0xffffffu) != 0xffffffu;
  return sum;
}

TEST(PanelTest, SphereSilhouetteMatchesItsProjection) {
  const Figure figure = OneSphere({0.1, 1.2, -0.3}, 0.2);
  for (const double yaw_rad : {0.0, 0.6, kPi / 2, kPi}) {
    const View view(yaw_rad, {0, 1, 0}, 150, 120, 250);
    const PanelOptions options{300, 240, PanelStyle::kPrimitives};
    const Pixels pixels = RenderPanel(figure, view, options);
    ASSERT_EQ(pixels.argb.size(), 300u * 240u);
    const Vector3d center = view.Project({0.1, 1.2, -0.3});
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 300; ++x) {
        const double distance = std::hypot(x + 0.5 - center.x(), y + 0.5 - center.y());
        const bool is_paper = pixels.argb[static_cast<std::size_t>(300 * y + x)] == 0xffffffffu;
        // Pixels at the rim are partly covered.
        if (std::abs(distance - 50.0) < 0.8) continue;
        ASSERT_EQ(is_paper, distance > 50.0) << x << ", " << y;
      }
    }
  }
}

TEST(PanelTest, StylesShowBodyPrimitivesOrBoth) {
  const Scene scene = SmallScene();
  const View view(0.0, {0, 0.85, 0}, 120, 120, 120);
  const auto covered = [&](PanelStyle style) {
    return Darkness(RenderPanel(scene.figure, view, {240, 240, style}));
  };
  const double body = covered(PanelStyle::kBody);
  const double set = covered(PanelStyle::kPrimitives);
  const double both = covered(PanelStyle::kBodyAndOutlines);
  EXPECT_GT(body, set);
  EXPECT_GT(both, body);                             // the ball stands over the head
  EXPECT_LT(both, body + set);                       // but most of the capsule lies over the trunk
  EXPECT_NEAR(covered(PanelStyle::kHeat), body, 3);  // a rim pixel may round to paper
}

TEST(FigureTest, GapsAreSignedDistances) {
  Figure figure = OneSphere({0, 0, 0}, 1.0);
  figure.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 0.5, 0}};
  EXPECT_THAT(Gaps(figure), testing::ElementsAre(-1.0, 1.0, -0.5));
}

TEST(FigureTest, CapsulesAndLonelySpheresBecomeSolids) {
  const Scene scene = SmallScene();
  ASSERT_EQ(scene.figure.solids.size(), 2u);
  EXPECT_FALSE(scene.figure.solids[0].IsSphere());
  EXPECT_TRUE(scene.figure.solids[1].IsSphere());
  EXPECT_EQ(scene.figure.triangles.size(), 2 * scene.soup.face_sizes.size());
}

TEST(FigureTest, TurnsUprightFromAnyAxis) {
  const ResultSet nothing;
  const std::vector<Vector3d> z_up = {{-0.8, -0.1, 0}, {0.8, 0.1, 1.7}};
  const Eigen::Matrix3d turn = TurnUpright(z_up, nothing, PictureUp::kAuto);
  EXPECT_EQ(turn * Vector3d(0, 0, 1), Vector3d(0, 1, 0));
  EXPECT_EQ(turn * Vector3d(0, -1, 0), Vector3d(0, 0, 1));  // faces -Y
  for (const PictureUp up : {PictureUp::kX, PictureUp::kY, PictureUp::kZ}) {
    EXPECT_NEAR(TurnUpright(z_up, nothing, up).determinant(), 1.0, 1e-12);
  }
}

TEST(FigureTest, LandmarksDecideTheFront) {
  ResultSet result;
  result.landmarks["left_wrist"] = {-0.5, 1, 0};  // the body faces -Z
  result.landmarks["right_wrist"] = {0.5, 1, 0};
  const Eigen::Matrix3d turn = TurnUpright({{0, 0, 0}, {0, 1.7, 0}}, result, PictureUp::kY);
  EXPECT_EQ(turn * Vector3d(0, 0, -1), Vector3d(0, 0, 1));
}

// Width and height from the header of a PNG.
std::pair<int, int> PngSize(const std::string& bytes) {
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      value = 256 * value + static_cast<unsigned char>(bytes[at + k]);
    }
    return value;
  };
  return {number(16), number(20)};
}

TEST(PictureTest, PngHasTheSizeAndTheSameBytesForAnyThreads) {
  const Scene scene = SmallScene();
  const std::vector<PictureColumn> columns = {{&scene.figure, 0.0, "front"},
                                              {&scene.figure, kPi / 2, "side"}};
  PictureOptions options;
  options.width = 420;
  options.height = 360;
  options.title = "a body";
  const auto once = DrawPicture(columns, options, PictureFormat::kPng, ThreadPool(1));
  const auto again = DrawPicture(columns, options, PictureFormat::kPng, ThreadPool(3));
  ASSERT_TRUE(once.ok() && again.ok());
  EXPECT_THAT(*once, StartsWith("\x89PNG"));
  EXPECT_EQ(PngSize(*once), std::pair(420, 360));
  EXPECT_TRUE(*once == *again);
  options.title = "another body";
  const auto other = DrawPicture(columns, options, PictureFormat::kPng, ThreadPool(1));
  EXPECT_FALSE(*once == *other) << "the title must show";
}

TEST(PictureTest, SvgIsOneDocumentOfTheSize) {
  const Scene scene = SmallScene();
  PictureOptions options;
  options.width = 300;
  options.height = 360;
  options.rows = {PanelStyle::kHeat, PanelStyle::kPrimitives};
  const auto svg =
      DrawPicture({{&scene.figure, 0.0, "front"}}, options, PictureFormat::kSvg, ThreadPool(1));
  ASSERT_TRUE(svg.ok());
  EXPECT_THAT(*svg, HasSubstr("<svg"));
  EXPECT_THAT(*svg, HasSubstr("</svg>"));
  EXPECT_THAT(*svg, HasSubstr("viewBox=\"0 0 300 360\""));
  EXPECT_THAT(*svg, HasSubstr("data:image/png;base64,"));
}

TEST(ColorTest, RampIsContinuousAndClamped) {
  EXPECT_EQ(SignedColor(2.0), SignedColor(1.0));
  EXPECT_EQ(SignedColor(-2.0), SignedColor(-1.0));
  for (double value = -1.0; value < 1.0; value += 0.001) {
    EXPECT_LT((SignedColor(value + 0.001) - SignedColor(value)).norm(), 0.01);
  }
}

}  // namespace
}  // namespace capfit::client
