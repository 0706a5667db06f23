#include "server/reset_guard.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/server/raw_connection.h"
#include "tests/server/secured_server.h"

namespace capfit::server {
namespace {

void BeginAndReset(const RawConnection& connection, std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t i = first; i < first + count; ++i) {
    connection.SendCall(2 * i + 1, "/capfit.v1.BodyApproximationService/ApproximateBody");
    connection.SendFrame(FrameType::kResetStream, 2 * i + 1, std::string("\0\0\0\x08", 4));
  }
}

TEST(ResetGuard, CutsOffOnlyTheConnectionThatResets) {
  const auto server = StartSecured({});
  RawConnection quiet(server->port());
  quiet.BeginHttp2();
  RawConnection resets(server->port());
  resets.BeginHttp2();
  BeginAndReset(resets, 0, kMostResets + 500);
  EXPECT_TRUE(resets.EndsWithin(/*seconds=*/20));
  EXPECT_TRUE(AskInfo(*server, {}).ok());
  EXPECT_FALSE(quiet.EndsWithin(/*seconds=*/1));
}

TEST(ResetGuard, WhoGivesUpNowAndThenIsLeftAlone) {
  const auto server = StartSecured({});
  RawConnection connection(server->port());
  connection.BeginHttp2();
  BeginAndReset(connection, 0, kMostResets / 2);
  EXPECT_FALSE(connection.EndsWithin(/*seconds=*/2));
}

// Whole calls and calls given up; the server lives on.
TEST(ResetGuard, LeavesGrpcsOwnServicesAlone) {
  const auto server = StartSecured({});
  RawConnection connection(server->port());
  connection.BeginHttp2();
  const std::string list_services("\0\0\0\0\x02\x3a\0", 7);
  constexpr char kEndOfStream = 1;
  for (std::uint32_t stream = 1; stream < 100; stream += 2) {
    connection.SendCall(stream, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo");
    if (stream % 4 == 1) {
      connection.SendFrame(FrameType::kData, stream, list_services, kEndOfStream);
    } else {
      connection.SendFrame(FrameType::kResetStream, stream, std::string("\0\0\0\x08", 4));
    }
  }
  EXPECT_FALSE(connection.EndsWithin(/*seconds=*/1));
  EXPECT_TRUE(AskInfo(*server, {}).ok());
}

TEST(CutConnection, FindsOnlyWhatIsThere) {
  EXPECT_FALSE(CutConnection("ipv4:192.0.2.7:4711"));
  EXPECT_FALSE(CutConnection("unix:/run/capfit"));
  EXPECT_FALSE(CutConnection(""));
}

}  // namespace
}  // namespace capfit::server
