#include "client/picture/polygon_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capfit::client {
namespace {

using Eigen::Vector2d;

// A round outline of radius `size`, with one circle that is larger and stands off.
FlatPolygon Round(const std::string& name, const std::string& part, double size) {
  FlatPolygon polygon;
  polygon.name = name;
  polygon.part = part;
  polygon.outside_area_ratio = 0.1234;
  polygon.outline = RimOf({{0, 0}, size});
  polygon.circles.push_back({{0.5 * size, 0.2 * size}, 1.1 * size});
  return polygon;
}

// As many cuts as bodies of few and of many primitives have.
std::vector<FlatPolygon> Cuts(int torso, int arm, int leg) {
  std::vector<FlatPolygon> cuts;
  const auto add = [&](const std::string& part, int count, double size) {
    for (int i = 0; i < count; ++i) {
      cuts.push_back(Round(part + "_middle_" + std::to_string(i), part, size / (1 + 0.1 * i)));
    }
  };
  add("torso", torso, 0.22);
  for (const char* const side : {"left", "right"}) add(side + std::string("_arm"), arm, 0.05);
  for (const char* const side : {"left", "right"}) add(side + std::string("_leg"), leg, 0.09);
  return cuts;
}

struct SheetCase {
  int torso, arm, leg;
  double width;
  std::optional<double> max_height;
};
class SheetTest : public testing::TestWithParam<SheetCase> {
 protected:
  const std::vector<FlatPolygon> cuts_ = Cuts(GetParam().torso, GetParam().arm, GetParam().leg);
  const Rect area_ = {20.0, 100.0, GetParam().width, 0.0};
  const SheetPlan plan_ = PlanSheet(cuts_, area_, GetParam().max_height, 12.0);
};

TEST_P(SheetTest, CellsFillTheAreaWithoutOverlap) {
  ASSERT_EQ(plan_.cells.size(), cuts_.size());
  if (GetParam().max_height) {
    EXPECT_LE(plan_.height, *GetParam().max_height);
  }
  const Rect whole = {area_.x - 1e-6, area_.y - 1e-6, area_.width + 2e-6, plan_.height + 2e-6};
  for (std::size_t i = 0; i < plan_.cells.size(); ++i) {
    EXPECT_TRUE(whole.Contains(plan_.cells[i].box)) << i;
    for (std::size_t j = 0; j < i; ++j) {
      Rect box = plan_.cells[i].box;
      box = {box.x + 1e-6, box.y + 1e-6, box.width - 2e-6, box.height - 2e-6};
      EXPECT_FALSE(box.Overlaps(plan_.cells[j].box)) << i << ", " << j;
    }
  }
}

TEST_P(SheetTest, DrawingsAndWordsStayInTheirCellsAtOneScale) {
  Page page;
  AddSheet(cuts_, plan_, 12.0, page);
  ASSERT_EQ(page.texts.size(), 2 * cuts_.size());
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    const Rect& cell = plan_.cells[i].box;
    EXPECT_TRUE(cell.Contains(page.texts[2 * i].box)) << page.texts[2 * i].text;
    EXPECT_TRUE(cell.Contains(page.texts[2 * i + 1].box));
    EXPECT_EQ(page.texts[2 * i + 1].text, "0.123");
    int found = 0;
    for (const PagePath& path : page.paths) {
      if (path.name.rfind(cuts_[i].name + ": ", 0) != 0) continue;
      const Rect box = BoxAround(path.points);
      EXPECT_TRUE(cell.Contains(box)) << path.name;
      EXPECT_FALSE(box.Overlaps(page.texts[2 * i].box)) << path.name;
      if (path.name == cuts_[i].name + ": outline") {
        EXPECT_NEAR(box.width, plan_.pixels_per_unit * BoxAround(cuts_[i].outline).width, 1e-6);
        ++found;
      }
      if (path.name == cuts_[i].name + ": circle") {
        EXPECT_NEAR(box.height, plan_.pixels_per_unit * 2.0 * cuts_[i].circles[0].radius, 1e-6);
        EXPECT_EQ(*path.stroke, PartColor(cuts_[i].part, 0.5));
        ++found;
      }
    }
    EXPECT_EQ(found, 2);
  }
}

TEST_P(SheetTest, LinesHoldOnePieceOfTheBody) {
  const auto piece = [](const FlatPolygon& p) { return p.part.substr(p.part.find('_') + 1); };
  for (std::size_t i = 1; i < cuts_.size(); ++i) {
    const bool same_line = plan_.cells[i].box.y == plan_.cells[i - 1].box.y;
    if (piece(cuts_[i]) != piece(cuts_[i - 1])) {
      EXPECT_FALSE(same_line) << cuts_[i].name;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Sizes, SheetTest,
                         testing::Values(SheetCase{6, 3, 4, 1472, {}},
                                         SheetCase{11, 6, 8, 1472, {}},
                                         SheetCase{11, 0, 0, 1472, {}}, SheetCase{0, 0, 1, 400, {}},
                                         SheetCase{6, 3, 4, 480, {}},
                                         SheetCase{6, 3, 4, 1472, 420.0},
                                         SheetCase{30, 14, 18, 1472, 1100.0}));

TEST(SheetDirectionTest, FrontIsDown) {
  FlatPolygon polygon = Round("hip", "torso", 0.2);
  polygon.circles = {{{0.1, -0.15}, 0.01}};  // y is up, so this is towards the front
  const SheetPlan plan = PlanSheet({polygon}, {0, 0, 600, 0}, std::nullopt, 12.0);
  Page page;
  AddSheet({polygon}, plan, 12.0, page);
  const auto middle_of = [&](const std::string& name) {
    for (const PagePath& path : page.paths) {
      const Rect box = BoxAround(path.points);
      if (path.name == name) return Vector2d(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    }
    return Vector2d(-1, -1);
  };
  const Vector2d step = middle_of("hip: circle") - middle_of("hip: outline");
  EXPECT_TRUE(step.isApprox(plan.pixels_per_unit * Vector2d(0.1, 0.15), 1e-6)) << step.transpose();
}

}  // namespace
}  // namespace capfit::client
