#include "server/admission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/base/status.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kMebibyte = 1024 * 1024;

AdmissionLimits Limits() {
  AdmissionLimits limits;
  limits.max_held_bytes = 100 * kMebibyte;
  limits.max_queued_seconds = 10.0;
  limits.max_jobs = 8;
  limits.concurrent_fits = 2;
  limits.client_share = 0.5;
  limits.least_pushback_ms = 200;
  return limits;
}

std::string Fact(const absl::Status& status, const std::string& name) {
  for (const auto& [known, value] : FactsOf(status)) {
    if (known == name) return value;
  }
  return "";
}

TEST(Admission, CountsWhatCallsHoldAndForgetsItWithThem) {
  Admission admission(Limits());
  {
    Holding one(admission, "a");
    Holding two(admission, "b");
    ASSERT_TRUE(one.Open().ok());
    ASSERT_TRUE(one.HoldBytes(10 * kMebibyte).ok());
    two.HoldAnyway(20 * kMebibyte);
    EXPECT_EQ(admission.held_bytes(), 30 * kMebibyte + 2 * kBytesOfACall);
    ASSERT_TRUE(one.HoldBytes(4 * kMebibyte).ok());
    EXPECT_EQ(admission.held_bytes(), 24 * kMebibyte + 2 * kBytesOfACall);
  }
  EXPECT_EQ(admission.held_bytes(), 0);
}

TEST(Admission, BytesBeyondTheBudgetAreRefusedAndNothingIsTaken) {
  Admission admission(Limits());
  Holding one(admission, "a");
  Holding two(admission, "b");
  Holding three(admission, "c");
  ASSERT_TRUE(one.HoldBytes(40 * kMebibyte).ok());
  ASSERT_TRUE(two.HoldBytes(40 * kMebibyte).ok());
  const std::int64_t before = admission.held_bytes();
  const absl::Status status = three.HoldBytes(30 * kMebibyte);
  EXPECT_EQ(ReasonOf(status), ErrorReason::kServerFull);
  EXPECT_EQ(Fact(status, kResourceFact), "held_bytes");
  EXPECT_EQ(Fact(status, kRetryFact), "200");
  EXPECT_EQ(admission.held_bytes(), before);
  EXPECT_TRUE(three.HoldBytes(10 * kMebibyte).ok());
}

TEST(Admission, AClientHasItsShareOfBytesAndNoMore) {
  Admission admission(Limits());
  Holding one(admission, "a");
  Holding two(admission, "a");
  ASSERT_TRUE(one.HoldBytes(30 * kMebibyte).ok());
  EXPECT_EQ(Fact(two.HoldBytes(30 * kMebibyte), kResourceFact), "client_held_bytes");
  Holding other(admission, "b");
  EXPECT_TRUE(other.HoldBytes(30 * kMebibyte).ok());
}

TEST(Admission, WhatCanNeverFitIsTheCallersMistake) {
  Admission admission(Limits());
  Holding one(admission, "a");
  for (const absl::Status& status :
       {one.HoldBytes(60 * kMebibyte), one.CheckClaim(60 * kMebibyte)}) {
    EXPECT_EQ(ReasonOf(status), ErrorReason::kTooLarge);
    EXPECT_THAT(std::string(status.message()),
                HasSubstr(std::to_string(50 * kMebibyte - kBytesOfACall)));
  }
}

TEST(Admission, AClaimTakesNothing) {
  Admission admission(Limits());
  Holding one(admission, "a");
  EXPECT_TRUE(one.CheckClaim(49 * kMebibyte).ok());
  EXPECT_EQ(admission.held_bytes(), 0);
}

TEST(Admission, WorkThatWouldWaitTooLongIsRefusedUntilThereIsLess) {
  Admission admission(Limits());
  Holding one(admission, "a");
  Holding two(admission, "b");
  Holding three(admission, "c");
  ASSERT_TRUE(one.BeginFit(15.0).ok());
  ASSERT_TRUE(two.BeginFit(9.0).ok());
  EXPECT_DOUBLE_EQ(admission.ExpectedWaitSeconds(), 12.0);
  const absl::Status status = three.BeginFit(0.1);
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(Fact(status, kResourceFact), "queued_seconds");
  EXPECT_EQ(Fact(status, kRetryFact), "2000") << "when the wait is 10 s again";
  two.EndFit();
  EXPECT_TRUE(three.BeginFit(0.1).ok());
}

TEST(Admission, AnythingFitsIntoAnIdleServer) {
  Admission admission(Limits());
  Holding one(admission, "a");
  EXPECT_TRUE(one.BeginFit(1e6).ok());
  one.EndFit();
  EXPECT_EQ(admission.ExpectedWaitSeconds(), 0.0);
}

TEST(Admission, AClientHasItsShareOfPlacesAndSeconds) {
  Admission admission(Limits());
  std::vector<std::unique_ptr<Holding>> many;
  for (int i = 0; i < 4; ++i) {
    many.push_back(std::make_unique<Holding>(admission, "a"));
    ASSERT_TRUE(many.back()->BeginFit(0.1).ok());
  }
  Holding more(admission, "a");
  EXPECT_EQ(Fact(more.BeginFit(0.1), kResourceFact), "client_queued_fits");
  Holding other(admission, "b");
  EXPECT_TRUE(other.BeginFit(11.0).ok()) << "the first of a client waits behind others only";
  Holding second(admission, "b");
  EXPECT_EQ(Fact(second.BeginFit(0.1), kResourceFact), "client_queued_seconds");
}

TEST(Admission, WhoWouldBeGoneBeforeItsTurnIsRefused) {
  Admission admission(Limits());
  const Holding one(admission, "a");
  EXPECT_TRUE(one.CheckPatience(4.9, 5.0).ok());
  EXPECT_TRUE(one.CheckPatience(0.0, -1.0).ok()) << "its turn is now: the fit itself looks";
  const absl::Status status = one.CheckPatience(7.5, 5.0);
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(Fact(status, kResourceFact), "deadline");
  EXPECT_EQ(Fact(status, kRetryFact), "2500");
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("would wait 7.5 s for its turn, and its deadline passes in 5.0 s"));
}

}  // namespace
}  // namespace capfit::server
