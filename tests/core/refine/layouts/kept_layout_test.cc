#include "core/refine/layouts/kept_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/base/status.h"
#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/refine/layouts/standard_layouts.h"
#include "tests/core/capsule/mirrored.h"

namespace capfit::refine {
namespace {

body::Body Mannequin(double height_m, bool with_hands = true) {
  mannequin::MannequinOptions options;
  options.faces = 5000;
  options.height_m = height_m;
  options.with_hands = with_hands;
  const auto prepared = mesh::PrepareMesh(*mannequin::MakeMannequin(options));
  return *body::FindBody(prepared->mesh, {}, ThreadPool(1), NullObserver());
}

const body::Body& Tall() {
  static const body::Body body = Mannequin(1.9);
  return body;
}
const body::Body& Small() {
  static const body::Body body = Mannequin(1.5);
  return body;
}

const KeptLayout& Standard() { return *FindStandardLayout("standard-32"); }

TEST(KeptLayout, HangsEverySphereByItsNumberWithItsImage) {
  const auto graph = HangLayout(Standard(), Tall());
  ASSERT_TRUE(graph.ok()) << graph.status();
  EXPECT_TRUE(capsule::IsExactlyMirrored(*graph));
  ASSERT_EQ(graph->spheres().size(), Standard().spheres.size());
  for (std::size_t v = 0; v < graph->spheres().size(); ++v) {
    const int mirror = Standard().spheres[v].mirror;
    EXPECT_EQ(graph->set().origins[v].mirror, mirror);
    Eigen::Vector3d image = graph->spheres()[v].center_m;
    image.x() = -image.x();
    EXPECT_EQ(graph->sphere(mirror).center_m, image) << v;
  }
  ASSERT_EQ(graph->capsules().size(), Standard().capsules.size());
  for (std::size_t e = 0; e < graph->capsules().size(); ++e) {
    EXPECT_EQ(graph->capsules()[e][0], Standard().capsules[e][0]);
    EXPECT_EQ(graph->capsules()[e][1], Standard().capsules[e][1]);
  }
}

// Taking places off a body and hanging them on it again moves nothing.
TEST(KeptLayout, PlacesLeadBackToWhereTheSpheresWere) {
  const capsule::PrimitiveSet set = HangLayout(Standard(), Tall())->set();
  KeptLayout layout = Standard();
  const auto places = PlacesOf(Skeleton(Tall()), set);
  for (std::size_t v = 0; v < places.size(); ++v) layout.spheres[v].place = places[v];
  const auto again = HangLayout(layout, Tall());
  ASSERT_TRUE(again.ok()) << again.status();
  for (std::size_t v = 0; v < places.size(); ++v) {
    EXPECT_LT((again->spheres()[v].center_m - set.spheres[v].center_m).norm(), 1e-9) << v;
    EXPECT_NEAR(again->spheres()[v].radius_m, set.spheres[v].radius_m, 1e-9) << v;
  }
}

// The mannequins differ by a scale, so the same places differ by it too.
TEST(KeptLayout, ScalesWithTheBody) {
  const auto tall = HangLayout(Standard(), Tall());
  const auto small = HangLayout(Standard(), Small());
  ASSERT_TRUE(tall.ok() && small.ok());
  const double scale = Tall().height_m / Small().height_m;
  for (std::size_t v = 0; v < tall->spheres().size(); ++v) {
    const Eigen::Vector3d scaled = scale * small->spheres()[v].center_m;
    EXPECT_LT((tall->spheres()[v].center_m - scaled).norm(), 0.03) << Standard().spheres[v].name;
  }
}

TEST(KeptLayout, NamesTheSpheresThatABodyHasNoPlaceFor) {
  const auto graph = HangLayout(Standard(), Mannequin(1.7, /*with_hands=*/false));
  EXPECT_EQ(graph.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ReasonOf(graph.status()), ErrorReason::kPartMissing);
  EXPECT_THAT(std::string(graph.status().message()), testing::HasSubstr("left_hand_1"));
}

TEST(KeptLayout, SaysWhatIsWrongWithALayout) {
  const auto refused = [](auto change) {
    KeptLayout layout = Standard();
    change(layout);
    const absl::Status status = CheckLayout(layout);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    return FieldOf(status).value_or("");
  };
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres.clear(); }), "layout.spheres");
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres.resize(501, l.spheres[0]); }), "layout.spheres");
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres[3].place.reset(); }), "layout.spheres[3].place");
  EXPECT_EQ(refused([](KeptLayout& l) {
              l.spheres[3].place->place.aside = std::numeric_limits<double>::quiet_NaN();
            }),
            "layout.spheres[3].place");
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres[3].place->radius = 0.0; }),
            "layout.spheres[3].place.radius");
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres[0].mirror = 32; }), "layout.spheres[0].mirror");
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres[0].mirror = 2; }), "layout.spheres[0].mirror");
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres[5].name = l.spheres[4].name; }),
            "layout.spheres[5].name");
  EXPECT_EQ(refused([](KeptLayout& l) { l.spheres[5].name = ""; }), "layout.spheres[5].name");
  EXPECT_EQ(refused([](KeptLayout& l) { l.capsules[2] = {1, 32}; }), "layout.capsules[2]");
  EXPECT_EQ(refused([](KeptLayout& l) { l.capsules[2] = {5, 5}; }), "layout.capsules[2]");
  EXPECT_EQ(refused([](KeptLayout& l) { l.capsules[2] = l.capsules[1]; }), "layout.capsules[2]");
}

TEST(StandardLayouts, AreSoundSymmetricAndWithinTheLimitsOfEngines) {
  for (const KeptLayout& layout : StandardLayouts()) {
    EXPECT_TRUE(CheckLayout(layout).ok()) << layout.name;
    EXPECT_LE(layout.spheres.size(), 32U);
    EXPECT_LE(layout.capsules.size(), 32U);
    std::set<std::string> names;
    for (const KeptSphere& sphere : layout.spheres) names.insert(sphere.name);
    for (const KeptSphere& sphere : layout.spheres) {
      std::string image = sphere.name;
      if (const auto at = image.find("left_"); at != std::string::npos) {
        image.replace(at, 5, "right_");
        EXPECT_EQ(layout.spheres[sphere.mirror].name, image);
      }
    }
  }
  EXPECT_EQ(FindStandardLayout("standard-31"), nullptr);
}

TEST(StandardLayouts, BonesHaveWords) {
  for (int b = 0; b < kBoneCount; ++b) {
    const auto bone = static_cast<BoneId>(b);
    EXPECT_EQ(BoneByName(BoneName(bone)), bone);
  }
  EXPECT_FALSE(BoneByName("tail").has_value());
}

}  // namespace
}  // namespace capfit::refine
