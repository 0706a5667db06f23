#include "server/reset_guard.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/server/raw_connection.h"
#include "tests/server/secured_server.h"

namespace capfit::server {
namespace {

constexpr char kMethod[] = "/capfit.v1.BodyApproximationService/ApproximateBody";

void BeginAndReset(const RawConnection& connection, std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t i = first; i < first + count; ++i) {
    connection.SendCall(2 * i + 1, kMethod);
    connection.SendFrame(FrameType::kResetStream, 2 * i + 1, std::string("\0\0\0\x08", 4));
  }
}

TEST(ResetGuard, CutsOffTheHostButForConnectionsThatAreAtWork) {
  const auto server = StartSecured({});
  RawConnection idle(server->port());
  idle.BeginHttp2();
  RawConnection uploads(server->port());
  uploads.BeginHttp2();
  uploads.SendCall(1, kMethod);
  v1::ApproximateBodyRequest header;
  header.mutable_header()->mutable_mesh()->mutable_arrays();
  const std::string message = header.SerializeAsString();
  const std::string length = {'\0', '\0', '\0', '\0', static_cast<char>(message.size())};
  uploads.SendFrame(FrameType::kData, 1, length + message);
  RawConnection now_and_then(server->port());
  now_and_then.BeginHttp2();
  BeginAndReset(now_and_then, 0, 10);
  EXPECT_TRUE(AskInfo(*server, {}).ok());  // what came before has been seen by then
  RawConnection resets(server->port());
  resets.BeginHttp2();
  BeginAndReset(resets, 0, kMostResets + 500);
  EXPECT_TRUE(resets.EndsWithin(/*seconds=*/20));
  EXPECT_TRUE(now_and_then.EndsWithin(/*seconds=*/20));
  EXPECT_TRUE(idle.EndsWithin(/*seconds=*/20));
  EXPECT_FALSE(uploads.EndsWithin(/*seconds=*/1));
  EXPECT_TRUE(AskInfo(*server, {}).ok()) << "who comes anew is let in";
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

TEST(CutConnections, TakesThoseOfThePortThatAreToBeCut) {
  const auto server = StartSecured({});
  RawConnection one(server->port());
  one.BeginHttp2();
  ASSERT_TRUE(AskInfo(*server, {}).ok());
  int asked = 0;
  EXPECT_EQ(CutConnections(server->port(),
                           [&](const std::string& peer) {
                             ++asked;
                             EXPECT_EQ(peer.rfind("ipv4:127.0.0.1:", 0), 0U) << peer;
                             return false;
                           }),
            0);
  EXPECT_GE(asked, 1);
  EXPECT_EQ(CutConnections(1, [](const std::string&) { return true; }), 0);
  EXPECT_FALSE(one.EndsWithin(/*seconds=*/1));
  EXPECT_GE(CutConnections(server->port(), [](const std::string&) { return true; }), 1);
  EXPECT_TRUE(one.EndsWithin(/*seconds=*/20));
}

}  // namespace
}  // namespace capfit::server
