#include "proto/wire/enum_conversion.h"

#include <gtest/gtest.h>

#include <set>

namespace capfit::wire {
namespace {

// Each core value goes out as its own number, never as an unknown one, and comes back.
template <typename Core>
void ExpectRoundTrip(int count) {
  std::set<int> numbers;
  for (int i = 0; i < count; ++i) {
    const auto core = static_cast<Core>(i);
    const auto wire = ToWire(core);
    EXPECT_EQ(FromWire(wire), core) << i;
    EXPECT_TRUE(numbers.insert(static_cast<int>(wire)).second) << "two values share " << wire;
  }
}

TEST(EnumConversion, EveryCoreValueComesBack) {
  ExpectRoundTrip<body::Unit>(5);
  ExpectRoundTrip<body::UpAxis>(4);
  ExpectRoundTrip<formats::MeshFormat>(6);
  ExpectRoundTrip<body::LandmarkMethod>(4);
  ExpectRoundTrip<body::Part>(body::kPartCount);
  ExpectRoundTrip<Stage>(kStageCount);
  ExpectRoundTrip<section::Sex>(3);
  ExpectRoundTrip<pipeline::FitMode>(2);
  ExpectRoundTrip<pipeline::Quality>(pipeline::kQualityCount);
  ExpectRoundTrip<pipeline::SkinningMode>(4);
}

TEST(EnumConversion, EveryWireValueIsKnownOrRefusedOnPurpose) {
  for (int i = v1::LengthUnit_MIN; i <= v1::LengthUnit_MAX; ++i) {
    EXPECT_TRUE(FromWire(static_cast<v1::LengthUnit>(i))) << i;
  }
  for (int i = v1::MeshFileFormat_MIN; i <= v1::MeshFileFormat_MAX; ++i) {
    EXPECT_TRUE(FromWire(static_cast<v1::MeshFileFormat>(i))) << i;
  }
  for (int i = v1::BodyPart_MIN + 1; i <= v1::BodyPart_MAX; ++i) {
    EXPECT_TRUE(FromWire(static_cast<v1::BodyPart>(i))) << i;
  }
  for (int i = v1::Stage_MIN + 1; i <= v1::Stage_MAX; ++i) {
    EXPECT_TRUE(FromWire(static_cast<v1::Stage>(i))) << i;
  }
  EXPECT_FALSE(FromWire(v1::BODY_PART_UNSPECIFIED));
}

TEST(EnumConversion, UnspecifiedGivesTheDocumentedDefault) {
  EXPECT_EQ(FromWire(v1::FIT_MODE_UNSPECIFIED), pipeline::FitMode::kEnclose);
  EXPECT_EQ(FromWire(v1::QUALITY_UNSPECIFIED), pipeline::Quality::kPaper);
  EXPECT_EQ(FromWire(v1::SEX_UNSPECIFIED), section::Sex::kAuto);
  EXPECT_EQ(FromWire(v1::SKINNING_FORM_UNSPECIFIED), pipeline::SkinningMode::kNone);
  EXPECT_EQ(FromWire(v1::LENGTH_UNIT_UNSPECIFIED), body::Unit::kAuto);
  EXPECT_EQ(FromWire(v1::UP_AXIS_UNSPECIFIED), body::UpAxis::kAuto);
}

TEST(EnumConversion, NumbersOfALaterVersionGiveNothing) {
  EXPECT_FALSE(FromWire(static_cast<v1::LengthUnit>(99)));
  EXPECT_FALSE(FromWire(static_cast<v1::FitMode>(99)));
  EXPECT_FALSE(FromWire(static_cast<v1::BodyPart>(-1)));
}

}  // namespace
}  // namespace capfit::wire
