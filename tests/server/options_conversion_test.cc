#include "proto/wire/options_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/base/status.h"
#include "core/refine/layouts/standard_layouts.h"
#include "proto/wire/enum_conversion.h"

namespace capfit::wire {
namespace {

using pipeline::FitOptions;

void ExpectSame(const FitOptions& a, const FitOptions& b) {
  EXPECT_EQ(a.max_primitives, b.max_primitives);
  EXPECT_EQ(a.max_spheres, b.max_spheres);
  EXPECT_EQ(a.max_capsules, b.max_capsules);
  EXPECT_EQ(a.polygon_error, b.polygon_error);
  EXPECT_EQ(a.fit, b.fit);
  EXPECT_EQ(a.quality, b.quality);
  EXPECT_EQ(a.skinning, b.skinning);
  EXPECT_EQ(a.parts.torso, b.parts.torso);
  EXPECT_EQ(a.parts.arms, b.parts.arms);
  EXPECT_EQ(a.parts.legs, b.parts.legs);
  EXPECT_EQ(a.parts.head, b.parts.head);
  EXPECT_EQ(a.parts.hands, b.parts.hands);
  EXPECT_EQ(a.parts.feet, b.parts.feet);
  EXPECT_EQ(a.sex, b.sex);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.landmarks, b.landmarks);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.want_polygons, b.want_polygons);
  EXPECT_EQ(a.tolerance_m, b.tolerance_m);
  EXPECT_EQ(a.want_vertex_gaps, b.want_vertex_gaps);
  EXPECT_EQ(a.require_parts.torso, b.require_parts.torso);
  EXPECT_EQ(a.require_parts.arms, b.require_parts.arms);
  EXPECT_EQ(a.require_parts.legs, b.require_parts.legs);
  EXPECT_EQ(a.require_parts.head, b.require_parts.head);
  EXPECT_EQ(a.require_parts.hands, b.require_parts.hands);
  EXPECT_EQ(a.require_parts.feet, b.require_parts.feet);
  EXPECT_EQ(a.engine, b.engine);
}

absl::StatusOr<FitOptions> RoundTrip(const FitOptions& options) {
  v1::ApproximateBodyHeader header;
  OptionsToWire(options, header);
  return OptionsFromWire(header);
}

TEST(OptionsConversion, AnEmptyHeaderGivesTheDefaults) {
  const auto options = OptionsFromWire({});
  ASSERT_TRUE(options.ok()) << options.status();
  ExpectSame(*options, FitOptions());
}

TEST(OptionsConversion, StandardLayoutsGoByName) {
  FitOptions options;
  options.layout = *refine::FindStandardLayout("standard-32");
  options.parts = options.layout->parts();
  v1::ApproximateBodyHeader header;
  OptionsToWire(options, header);
  EXPECT_EQ(header.layout().name(), "standard-32");
  // Without parts those of the layout.
  header.mutable_options()->clear_parts();
  const auto back = OptionsFromWire(header);
  ASSERT_TRUE(back.ok()) << back.status();
  ExpectSame(*back, options);
  EXPECT_EQ(back->layout->spheres.size(), options.layout->spheres.size());
}

TEST(OptionsConversion, OtherLayoutsComeBackWhole) {
  FitOptions options;
  options.layout = *refine::FindStandardLayout("standard-32");
  options.layout->name.clear();
  options.layout->spheres[3].mirror = -1;
  const auto back = RoundTrip(options);
  ASSERT_TRUE(back.ok()) << back.status();
  const refine::KeptLayout& layout = *back->layout;
  EXPECT_EQ(layout.name, "");
  EXPECT_EQ(layout.capsules, options.layout->capsules);
  ASSERT_EQ(layout.spheres.size(), options.layout->spheres.size());
  for (std::size_t i = 0; i < layout.spheres.size(); ++i) {
    const refine::KeptSphere& sphere = layout.spheres[i];
    const refine::KeptSphere& wanted = options.layout->spheres[i];
    EXPECT_EQ(sphere.name, wanted.name);
    EXPECT_EQ(sphere.part, wanted.part);
    EXPECT_EQ(sphere.mirror, wanted.mirror);
    EXPECT_EQ(sphere.place->bone, wanted.place->bone);
    EXPECT_EQ(sphere.place->side, wanted.place->side);
    EXPECT_EQ(sphere.place->place.along, wanted.place->place.along);
    EXPECT_EQ(sphere.place->place.aside, wanted.place->place.aside);
    EXPECT_EQ(sphere.place->place.ahead, wanted.place->place.ahead);
    EXPECT_EQ(sphere.place->radius, wanted.place->radius);
  }
}

TEST(OptionsConversion, SaysWhatIsWrongWithALayout) {
  v1::ApproximateBodyHeader header;
  const auto field = [&header] { return FieldOf(OptionsFromWire(header).status()).value_or(""); };
  header.mutable_layout();
  EXPECT_EQ(field(), "layout");
  header.mutable_layout()->set_name("standard-1000");
  EXPECT_EQ(field(), "layout.name");
  v1::Sphere& sphere = *header.mutable_layout()->mutable_set()->add_spheres();
  EXPECT_EQ(field(), "layout.set.spheres[0].part");
  sphere.set_part(v1::BODY_PART_HEAD);
  sphere.mutable_place();
  EXPECT_EQ(field(), "layout.set.spheres[0].place.bone");
  sphere.mutable_place()->set_bone(v1::BONE_HEAD);
  sphere.set_name("head_1");
  const auto options = OptionsFromWire(header);
  ASSERT_TRUE(options.ok()) << options.status();
  EXPECT_EQ(FieldOf(WithWirePaths(pipeline::ValidateOptions(*options), header.options())),
            "layout.set.spheres[0].place.radius");
}

TEST(OptionsConversion, DefaultsComeBack) {
  const auto options = RoundTrip({});
  ASSERT_TRUE(options.ok()) << options.status();
  ExpectSame(*options, FitOptions());
}

TEST(OptionsConversion, EveryOptionComesBack) {
  FitOptions options;
  options.max_primitives = 77;
  options.fit = pipeline::FitMode::kBestFit;
  options.quality = pipeline::Quality::kTight;
  options.skinning = pipeline::SkinningMode::kDense;
  options.parts = {.torso = false, .arms = true, .legs = false, .head = true, .feet = true};
  options.sex = section::Sex::kFemale;
  options.unit = body::Unit::kInch;
  options.up = body::UpAxis::kZ;
  options.landmarks = {{body::LandmarkId::kLeftWrist, {0.1, 1.0 / 3.0, -7e-300}},
                       {body::LandmarkId::kCrotch, {1, 2, 3}}};
  options.seed = std::numeric_limits<std::uint64_t>::max();
  options.want_polygons = true;
  options.tolerance_m = 0.0025;
  options.want_vertex_gaps = true;
  options.require_parts.arms = true;
  options.require_parts.head = true;
  options.engine = "unity_cloth";
  const auto back = RoundTrip(options);
  ASSERT_TRUE(back.ok()) << back.status();
  ExpectSame(*back, options);
}

TEST(OptionsConversion, TheOtherBudgetsComeBack) {
  FitOptions by_error;
  by_error.polygon_error = 0.125;
  FitOptions by_engine;
  by_engine.max_spheres = 32;
  by_engine.max_capsules = 31;
  FitOptions spheres_only;
  spheres_only.max_spheres = 20;
  for (const FitOptions& options : {by_error, by_engine, spheres_only}) {
    const auto back = RoundTrip(options);
    ASSERT_TRUE(back.ok()) << back.status();
    ExpectSame(*back, options);
  }
}

struct Misuse {
  std::string name;
  std::function<void(v1::ApproximateBodyHeader&)> spoil;
  std::string field;
  friend void PrintTo(const Misuse& m, std::ostream* os) { *os << m.name; }
};
class OptionsMisuse : public testing::TestWithParam<Misuse> {};

TEST_P(OptionsMisuse, NamesTheField) {
  v1::ApproximateBodyHeader header;
  GetParam().spoil(header);
  const absl::Status status = OptionsFromWire(header).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_EQ(FieldOf(status).value_or("none"), GetParam().field) << status;
}

void AddLandmark(v1::ApproximateBodyHeader& header, const char* name, double x) {
  v1::Landmark& landmark = *header.mutable_options()->add_landmarks();
  landmark.set_name(name);
  landmark.mutable_position()->set_x(x);
}

INSTANTIATE_TEST_SUITE_P(
    All, OptionsMisuse,
    testing::Values(
        Misuse{"Unit", [](auto& h) { h.mutable_mesh()->set_unit(v1::LengthUnit(9)); }, "mesh.unit"},
        Misuse{"Up", [](auto& h) { h.mutable_mesh()->set_up_axis(v1::UpAxis(9)); }, "mesh.up_axis"},
        Misuse{"FitMode", [](auto& h) { h.mutable_options()->set_fit_mode(v1::FitMode(9)); },
               "options.fit_mode"},
        Misuse{"Skinning", [](auto& h) { h.mutable_options()->set_skinning(v1::SkinningForm(9)); },
               "options.skinning"},
        Misuse{
            "EmptyBudget",
            [](auto& h) { h.mutable_options()->mutable_budget()->mutable_spheres_and_capsules(); },
            "options.budget.spheres_and_capsules"},
        Misuse{"UnknownPart",
               [](auto& h) {
                 h.mutable_options()->add_parts(v1::BODY_PART_GROUP_ARMS);
                 h.mutable_options()->add_parts(v1::BODY_PART_GROUP_UNSPECIFIED);
               },
               "options.parts[1]"},
        Misuse{"PartTwice",
               [](auto& h) {
                 h.mutable_options()->add_parts(v1::BODY_PART_GROUP_ARMS);
                 h.mutable_options()->add_parts(v1::BODY_PART_GROUP_ARMS);
               },
               "options.parts[1]"},
        Misuse{"UnknownLandmark", [](auto& h) { AddLandmark(h, "left_antenna", 1); },
               "options.landmarks[0].name"},
        Misuse{"LandmarkTwice",
               [](auto& h) {
                 AddLandmark(h, "neck", 1);
                 AddLandmark(h, "neck", 2);
               },
               "options.landmarks[1].name"},
        Misuse{"LandmarkNotFinite",
               [](auto& h) { AddLandmark(h, "neck", std::numeric_limits<double>::quiet_NaN()); },
               "options.landmarks[0].position"},
        Misuse{"LandmarkWithoutPosition",
               [](auto& h) { h.mutable_options()->add_landmarks()->set_name("neck"); },
               "options.landmarks[0].position"}),
    [](const auto& test) { return test.param.name; });

TEST(OptionsConversion, EveryFormOfSkinningIsMade) {
  for (const v1::SkinningForm form :
       {v1::SKINNING_FORM_DENSE, v1::SKINNING_FORM_SPARSE, v1::SKINNING_FORM_BONES}) {
    v1::ApproximateBodyHeader header;
    header.mutable_options()->set_skinning(form);
    const auto options = OptionsFromWire(header);
    ASSERT_TRUE(options.ok()) << options.status();
    EXPECT_EQ(ToWire(options->skinning), form);
  }
}

}  // namespace
}  // namespace capfit::wire
