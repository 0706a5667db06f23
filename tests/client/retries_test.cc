#include "client/retries.h"

#include <gtest/gtest.h>

#include <vector>

#include "absl/status/statusor.h"

namespace capfit::client {
namespace {

using std::chrono::milliseconds;

TEST(PauseAfter, GrowsForServersThatAreGoneUpToTenSeconds) {
  const grpc::ClientContext context;
  const absl::Status gone = absl::UnavailableError("gone");
  std::vector<long> pauses;
  for (int attempt = 1; attempt < 9; ++attempt) {
    pauses.push_back(PauseAfter(gone, attempt, 100, context)->count());
  }
  EXPECT_EQ(pauses, (std::vector<long>{200, 400, 800, 1600, 3200, 6400, 10'000, 10'000}));
  EXPECT_EQ(PauseAfter(gone, 99, 100, context)->count(), 10'000);
}

TEST(PauseAfter, GrowsWhereOthersFillTheServersMemory) {
  const grpc::ClientContext context;
  const absl::Status ended = absl::ResourceExhaustedError("Received RST_STREAM with error code 11");
  EXPECT_EQ(PauseAfter(ended, 1, 4, context)->count(), 200);
  EXPECT_EQ(PauseAfter(ended, 2, 4, context)->count(), 400);
  EXPECT_FALSE(PauseAfter(ended, 4, 4, context)) << "the last attempt";
}

TEST(PauseAfter, IsNothingWhereAnotherAttemptIsOfNoUse) {
  const grpc::ClientContext context;
  EXPECT_FALSE(PauseAfter(absl::UnavailableError("gone"), 4, 4, context)) << "the last attempt";
  EXPECT_FALSE(PauseAfter(absl::ResourceExhaustedError("full"), 1, 4, context)) << "no pause named";
  for (const absl::Status& status :
       {absl::InvalidArgumentError("x"), absl::CancelledError("x"), absl::InternalError("x"),
        absl::DeadlineExceededError("x"), absl::UnauthenticatedError("x")}) {
    EXPECT_FALSE(PauseAfter(status, 1, 4, context)) << status;
  }
}

TEST(WithRetries, StopsAtSuccessAtTheLastAttemptAndBeforeTheDeadline) {
  int attempts = 0;
  const auto succeed_at = [&](int number) {
    return [&attempts, number](grpc::ClientContext&) -> absl::StatusOr<int> {
      if (++attempts < number) return absl::UnavailableError("gone");
      return attempts;
    };
  };
  EXPECT_EQ(*WithRetries(60.0, 4, succeed_at(2)), 2);
  attempts = 0;
  EXPECT_FALSE(WithRetries(60.0, 2, succeed_at(9)).ok());
  EXPECT_EQ(attempts, 2);
  attempts = 0;
  EXPECT_FALSE(WithRetries(0.1, 4, succeed_at(9)).ok());
  EXPECT_EQ(attempts, 1) << "the pause alone would end after the deadline";
}

}  // namespace
}  // namespace capfit::client
