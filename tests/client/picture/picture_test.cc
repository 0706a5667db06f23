#include "client/picture/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "client/picture/result_set.h"
#include "core/base/status.h"
#include "core/body/anatomy.h"
#include "core/mannequin/mannequin.h"
#include "tests/client/picture/read_png.h"

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
  formats::PolygonSoup soup;
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
        const bool is_paper = pixels.argb[300 * y + x] == 0xffffffffu;
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

// A body of the mannequin with the primitives' places of its parts taken by balls of all ten.
struct Person {
  Figure figure;
  std::vector<LegendEntry> legend;
};

Person MakePerson(double height_m, mannequin::MannequinPose pose, double unit_per_m) {
  mannequin::MannequinOptions options;
  options.faces = 2'000;
  options.height_m = height_m;
  options.pose = pose;
  formats::PolygonSoup soup = *mannequin::MakeMannequin(options);
  for (Vector3d& p : soup.positions) p *= unit_per_m;
  ResultSet result;
  Person person;
  for (int p = 0; p < body::kPartCount; ++p) {
    const std::string name(body::PartName(static_cast<body::Part>(p)));
    result.spheres.push_back({{0, (0.1 + 0.1 * p) * height_m * unit_per_m, 0}, 0.1 * unit_per_m});
    result.sphere_parts.push_back(name);
    person.legend.push_back({Spaced(name), PartColor(name, 0.5)});
  }
  std::vector<Vector3d> centers;
  for (const geometry::Sphere& sphere : result.spheres) centers.push_back(sphere.center_m);
  person.figure = MakeFigure(soup, result, soup.positions, centers, Eigen::Matrix3d::Identity());
  person.legend.push_back({"not fitted", kNotFitted});
  return person;
}

std::vector<PictureColumn> ThreeColumns(const Figure& figure) {
  return {{&figure, 0.0, "front"}, {&figure, kPi / 2, "left side"}, {&figure, kPi, "back"}};
}

PictureOptions FullOptions(const Person& person, double mm_per_unit) {
  PictureOptions options;
  options.title = "a body with a rather long name, as files have them.obj";
  options.subtitle = "n_p 64     27 spheres + 37 capsules     E_r 0.252     quality tight";
  options.note = "not fitted: head, hands, feet";
  options.rows = {PanelStyle::kHeat, PanelStyle::kPrimitives};
  options.legend = person.legend;
  options.mm_per_unit = mm_per_unit;
  return options;
}

const PagePath* PathNamed(const Page& page, const std::string& name) {
  for (const PagePath& path : page.paths) {
    if (path.name == name) return &path;
  }
  return nullptr;
}

bool HasText(const Page& page, const std::string& text) {
  return std::any_of(page.texts.begin(), page.texts.end(),
                     [&](const PageText& line) { return line.text == text; });
}

struct PageCase {
  std::string name;
  double height_m;
  mannequin::MannequinPose pose;
  int width;
  int height;
};
class PageTest : public testing::TestWithParam<PageCase> {
 protected:
  const Person person_ = MakePerson(GetParam().height_m, GetParam().pose, 1.0);
  [[nodiscard]] Page LayOut() const {
    PictureOptions options = FullOptions(person_, 1000.0);
    options.width = GetParam().width;
    options.height = GetParam().height;
    return *LayOutPage(ThreeColumns(person_.figure), options);
  }
};

TEST_P(PageTest, NothingOverlapsOrLeavesThePage) {
  const Page page = LayOut();
  const Rect whole = {0, 0, static_cast<double>(page.width), static_cast<double>(page.height)};
  for (std::size_t i = 0; i < page.texts.size(); ++i) {
    const PageText& text = page.texts[i];
    EXPECT_TRUE(whole.Contains(text.box)) << text.text;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(text.box.Overlaps(page.texts[j].box)) << text.text << ", " << page.texts[j].text;
    }
    for (const PagePanel& panel : page.panels) {
      EXPECT_FALSE(text.box.Overlaps(panel.box)) << text.text;
    }
    for (const PagePath& path : page.paths) {
      EXPECT_FALSE(text.box.Overlaps(BoxAround(path.points))) << text.text << ", " << path.name;
    }
  }
  for (const PagePath& path : page.paths) {
    EXPECT_TRUE(whole.Contains(BoxAround(path.points))) << path.name;
  }
}

TEST_P(PageTest, FiguresStayInTheirPanels) {
  const Page page = LayOut();
  ASSERT_EQ(page.panels.size(), 6u);
  for (std::size_t i = 0; i < page.panels.size(); ++i) {
    const PagePanel& panel = page.panels[i];
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(panel.box.Overlaps(page.panels[j].box));
    const Rect inside = {0, 0, panel.box.width, panel.box.height};
    for (const Vector3d& p : person_.figure.vertices) {
      const Vector3d at = panel.view.Project(p);
      ASSERT_TRUE(inside.Contains({at.x(), at.y(), 0, 0})) << i;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(
    Bodies, PageTest,
    testing::Values(PageCase{"WideTPose", 2.2, mannequin::MannequinPose::kT, 1500, 1100},
                    PageCase{"TallAtSides", 2.3, mannequin::MannequinPose::kSides, 1500, 1100},
                    PageCase{"Child", 0.8, mannequin::MannequinPose::kA, 1500, 1100},
                    PageCase{"Small", 1.7, mannequin::MannequinPose::kA, 400, 400},
                    PageCase{"Narrow", 1.7, mannequin::MannequinPose::kT, 300, 900},
                    PageCase{"Low", 1.7, mannequin::MannequinPose::kT, 2400, 400},
                    PageCase{"Large", 1.7, mannequin::MannequinPose::kT, 6000, 4400}),
    [](const auto& test) { return test.param.name; });

TEST(PageContentTest, ScaleBarIsAsLongAsTheBodyIsDrawnInAnyUnit) {
  for (const double unit_per_m : {1.0, 100.0, 1000.0, 39.3701}) {
    const Person person = MakePerson(1.7, mannequin::MannequinPose::kA, unit_per_m);
    const Page page =
        *LayOutPage(ThreeColumns(person.figure), FullOptions(person, 1000.0 / unit_per_m));
    const PagePath* const bar = PathNamed(page, "scale bar");
    ASSERT_NE(bar, nullptr);
    EXPECT_TRUE(HasText(page, "50 cm")) << unit_per_m;
    const double pixels = (bar->points.back() - bar->points.front()).norm();
    for (const PagePanel& panel : page.panels) {
      const Vector3d from = panel.view.Project({0, 0, 0});
      const Vector3d to = panel.view.Project({0, 0.5 * unit_per_m, 0});
      EXPECT_NEAR((to - from).head<2>().norm(), pixels, 1e-6 * pixels);
    }
  }
}

TEST(PageContentTest, UnknownUnitHasNoScaleBar) {
  const Person person = MakePerson(1.7, mannequin::MannequinPose::kA, 1.0);
  PictureOptions options = FullOptions(person, 1000.0);
  options.mm_per_unit.reset();
  EXPECT_EQ(PathNamed(*LayOutPage(ThreeColumns(person.figure), options), "scale bar"), nullptr);
}

TEST(PageContentTest, WordsOfTheResultAreOnThePage) {
  const Person person = MakePerson(1.7, mannequin::MannequinPose::kA, 1.0);
  const PictureOptions options = FullOptions(person, 1000.0);
  const Page page = *LayOutPage(ThreeColumns(person.figure), options);
  for (const std::string& words : {options.subtitle, options.note, std::string("gap, mm"),
                                   std::string("+30"), std::string("-15"), std::string("torso")}) {
    EXPECT_TRUE(HasText(page, words)) << words;
  }
}

// Two cuts of the trunk with a circle each.
std::vector<FlatPolygon> TwoCuts() {
  const auto cut = [](const std::string& name, double y) {
    ResultPolygon polygon{name, "torso", {}, {{{0, y, 0}, 0.13}}, 0.2};
    for (int i = 0; i < 32; ++i) {
      const double t = 2.0 * kPi * i / 32;
      polygon.outline.emplace_back(0.16 * std::cos(t), y, 0.1 * std::sin(t));
    }
    return polygon;
  };
  return Flatten({cut("hip", 0.9), cut("waist", 1.1)}, Eigen::Matrix3d::Identity());
}

TEST(PageContentTest, PolygonsAreDrawnInPlaceAndOnASheetWithItsOwnScaleBar) {
  Person person = MakePerson(1.7, mannequin::MannequinPose::kT, 1.0);
  person.figure.curves = CurvesOf(TwoCuts());
  PictureOptions options = FullOptions(person, 1000.0);
  options.rows = {PanelStyle::kGhost};
  options.polygons = TwoCuts();
  const Page page = *LayOutPage({{&person.figure, 0.0, "front", 0.4}}, options);
  ASSERT_EQ(page.panels.size(), 1u);
  const PagePanel& panel = page.panels[0];
  // Every point in place is a point of the curve as this panel's view shows it.
  int in_place = 0;
  for (const PagePath& path : page.paths) {
    if (path.name != "hip: outline in place") continue;
    for (const Eigen::Vector2d& p : path.points) {
      double nearest = 1e9;
      for (const Vector3d& q : person.figure.curves[1].points) {
        const Eigen::Vector2d at = panel.view.Project(q).head<2>();
        nearest = std::min(nearest, (p - at - Eigen::Vector2d(panel.box.x, panel.box.y)).norm());
      }
      EXPECT_LT(nearest, 1e-9);
      ++in_place;
    }
  }
  EXPECT_GE(in_place, 32);
  std::vector<const PagePath*> bars;
  for (const PagePath& path : page.paths) {
    if (path.name == "scale bar") bars.push_back(&path);
  }
  ASSERT_EQ(bars.size(), 2u);
  const PagePath* const outline = PathNamed(page, "hip: outline");
  ASSERT_NE(outline, nullptr);
  const double bar_px = (bars[1]->points.back() - bars[1]->points.front()).norm();
  const double pixels_per_unit = BoxAround(outline->points).width / 0.32;
  EXPECT_TRUE(HasText(page, "20 cm"));
  EXPECT_NEAR(bar_px, 0.2 * pixels_per_unit, 1e-6 * bar_px);
  EXPECT_GT(BoxAround(outline->points).y, panel.box.bottom());
  EXPECT_LE(page.texts.back().box.bottom(), page.height);
}

TEST(PageContentTest, PolygonsThatDoNotFitInAreRefusedWithTheHeightThatDoes) {
  const Person person = MakePerson(1.7, mannequin::MannequinPose::kT, 1.0);
  PictureOptions options = FullOptions(person, 1000.0);
  options.rows = {PanelStyle::kGhost};
  for (int i = 0; i < 20; ++i) {
    for (const FlatPolygon& polygon : TwoCuts()) options.polygons.push_back(polygon);
  }
  options.height = 300;
  const auto page = LayOutPage(ThreeColumns(person.figure), options);
  ASSERT_FALSE(page.ok());
  EXPECT_EQ(FieldOf(page.status()), "height");
  EXPECT_THAT(std::string(page.status().message()), HasSubstr("for 40 polygons"));
  options.height.reset();
  EXPECT_TRUE(LayOutPage(ThreeColumns(person.figure), options).ok());
}

Color ColorAt(const Pixels& pixels, const Eigen::Vector2d& at) {
  const std::uint32_t argb =
      pixels.argb[static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(pixels.width) +
                  static_cast<std::size_t>(at.x())];
  return {static_cast<float>(argb >> 16 & 255u) / 255.0f,
          static_cast<float>(argb >> 8 & 255u) / 255.0f, static_cast<float>(argb & 255u) / 255.0f};
}

TEST(PictureTest, PixelsOfTheLegendAndTheScaleBarAreWhatTheySay) {
  const Person person = MakePerson(1.7, mannequin::MannequinPose::kA, 1.0);
  const PictureOptions options = FullOptions(person, 1000.0);
  const auto columns = ThreeColumns(person.figure);
  const Pixels pixels = ReadPng(*DrawPicture(columns, options, PictureFormat::kPng, ThreadPool(2)));
  const Page page = *LayOutPage(columns, options);
  ASSERT_EQ(pixels.width, page.width);
  for (const LegendEntry& entry : person.legend) {
    const PagePath* const mark = PathNamed(page, entry.words);
    ASSERT_NE(mark, nullptr) << entry.words;
    const Rect box = BoxAround(mark->points);
    const Color seen = ColorAt(pixels, {box.x + 0.5 * box.width, box.y + 0.5 * box.height});
    EXPECT_LT((seen - entry.color).cwiseAbs().maxCoeff(), 1.5f / 255.0f) << entry.words;
  }
  const PagePath* const bar = PathNamed(page, "scale bar");
  int inked = 0;
  // From a little before the bar to a little behind it: its label follows.
  const int begin = static_cast<int>(bar->points[0].x()) - 4;
  const int end = static_cast<int>(bar->points[1].x()) + 4;
  for (int x = begin; x <= end; ++x) {
    inked += ColorAt(pixels, {x, bar->points[0].y()}).x() < 0.6f;
  }
  EXPECT_NEAR(inked, (bar->points[1] - bar->points[0]).norm(), 2.5);
}

TEST(PanelTest, PartsThatAreNotFittedAreGrey) {
  Figure figure;
  figure.vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  figure.triangles = {{0, 1, 2}};
  const View view(0.0, {0, 0, 0}, 20, 20, 10);
  const auto middle = [&](PanelStyle style) {
    const Pixels pixels = RenderPanel(figure, view, {40, 40, style});
    return ColorAt(pixels, {20, 22});
  };
  const auto is_grey = [](const Color& color) {
    return std::abs(color.x() - color.z()) < 0.01f && color.x() < 0.9f;
  };
  EXPECT_FALSE(is_grey(middle(PanelStyle::kBody)));
  figure.is_fitted = {false, false, false};
  EXPECT_TRUE(is_grey(middle(PanelStyle::kBody)));
  figure.gaps.assign(3, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(is_grey(middle(PanelStyle::kHeat)));
}

}  // namespace
}  // namespace capfit::client
