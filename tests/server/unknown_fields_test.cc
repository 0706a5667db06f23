#include "proto/wire/unknown_fields.h"

#include <gmock/gmock.h>
#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

#include "capfit/v1/service.pb.h"

namespace capfit::wire {
namespace {

void AddUnknown(google::protobuf::Message& message, int number) {
  message.GetReflection()->MutableUnknownFields(&message)->AddVarint(number, 1);
}

TEST(UnknownFields, AKnownRequestHasNone) {
  v1::ApproximateBodyRequest request;
  request.mutable_header()->mutable_options()->mutable_budget()->set_max_primitives(64);
  request.mutable_header()->mutable_mesh()->mutable_file();
  EXPECT_EQ(UnknownFieldsOf(request), std::nullopt);
}

TEST(UnknownFields, AreNamedWhereTheyStand) {
  v1::ApproximateBodyUnaryRequest request;
  AddUnknown(request, 77);
  AddUnknown(*request.mutable_options(), 1001);
  AddUnknown(*request.mutable_options()->mutable_budget(), 9);
  AddUnknown(*request.mutable_options()->add_landmarks()->mutable_position(), 5);
  const std::optional<Warning> warning = UnknownFieldsOf(request);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->code, "UNKNOWN_FIELDS");
  EXPECT_EQ(warning->count, 4);
  for (const char* const place :
       {"field 77 of ApproximateBodyUnaryRequest", "field 1001 of options",
        "field 9 of options.budget", "field 5 of options.landmarks[0].position"}) {
    EXPECT_THAT(warning->message, testing::HasSubstr(place));
  }
}

TEST(UnknownFields, AFloodOfThemIsCountedNotListed) {
  v1::ApproximateBodyUnaryRequest request;
  for (int i = 0; i < 100'000; ++i) AddUnknown(*request.mutable_options(), 1000 + i % 50'000);
  const std::optional<Warning> warning = UnknownFieldsOf(request);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->count, 100'000);
  EXPECT_LT(warning->message.size(), 1000U);
}

}  // namespace
}  // namespace capfit::wire
