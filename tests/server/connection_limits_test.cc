// What one connection can do to the others: nothing.
#include <gmock/gmock.h>
#include <grpcpp/client_context.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "capfit/v1/service.grpc.pb.h"
#include "client/connection.h"
#include "server/exposure.h"
#include "tests/server/certificates.h"
#include "tests/server/raw_connection.h"
#include "tests/server/secured_server.h"

namespace capfit::server {
namespace {

std::unique_ptr<v1::BodyApproximationService::Stub> StubOf(const Server& server) {
  return v1::BodyApproximationService::NewStub(
      *client::OpenChannel("127.0.0.1:" + std::to_string(server.port()), {}));
}

// Of this process, server and test together.
long ResidentKilobytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "VmRSS:") {
  }
  long kilobytes = 0;
  status >> kilobytes;
  EXPECT_GT(kilobytes, 0);
  return kilobytes;
}

TEST(ConnectionLimits, ConnectionsThatSayNothingAreClosedAndOthersServed) {
  const auto server = StartSecured({});
  std::vector<std::unique_ptr<RawConnection>> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(std::make_unique<RawConnection>(server->port()));
  EXPECT_TRUE(AskInfo(*server, {}).ok());
  EXPECT_TRUE(silent.front()->EndsWithin(/*seconds=*/60));
}

TEST(ConnectionLimits, ATlsHandshakeThatIsNeverFinishedStopsNobody) {
  const CertificateAndKey authority = MakeAuthority("slow");
  const CertificateAndKey pair = MakeCertificate(authority);
  ServerConfig config;
  config.tls.certificate_file = WriteTestFile("slow.pem", pair.certificate);
  config.tls.key_file = WriteTestFile("slow.key", pair.key);
  const auto server = StartSecured(config);
  std::vector<std::unique_ptr<RawConnection>> slow;
  for (int i = 0; i < 100; ++i) {
    slow.push_back(std::make_unique<RawConnection>(server->port()));
    slow.back()->Send("\x16\x03\x01");  // the first bytes of a TLS record
  }
  client::Security security;
  security.root_certificates = authority.certificate;
  EXPECT_TRUE(AskInfo(*server, security).ok());
}

TEST(ConnectionLimits, WhoPingsWithoutEndIsSentAway) {
  const auto server = StartSecured({});
  RawConnection connection(server->port());
  connection.BeginHttp2();
  for (int i = 0; i < 1000; ++i) connection.SendFrame(FrameType::kPing, 0, std::string(8, 'p'));
  EXPECT_TRUE(connection.EndsWithin(/*seconds=*/20));
  EXPECT_TRUE(AskInfo(*server, {}).ok());
}

TEST(ConnectionLimits, MessagesThatClaimAGigabyteReserveNothing) {
  const auto server = StartSecured({});
  const long before_kb = ResidentKilobytes();
  std::vector<std::unique_ptr<RawConnection>> liars;
  for (int i = 0; i < 50; ++i) {
    liars.push_back(std::make_unique<RawConnection>(server->port()));
    liars.back()->BeginHttp2();
    liars.back()->SendCall(1, "/capfit.v1.BodyApproximationService/ApproximateBodyUnary");
    // Not packed, 1 GiB long; ten bytes of it.
    liars.back()->SendFrame(FrameType::kData, 1, std::string("\0\x40\0\0\0", 5) + "0123456789");
  }
  EXPECT_TRUE(AskInfo(*server, {}).ok());
  EXPECT_LT(ResidentKilobytes() - before_kb, 100 * 1024);
}

TEST(ConnectionLimits, StreamsThatAreResetAtOnceAreHarmless) {
  const auto server = StartSecured({});
  RawConnection connection(server->port());
  connection.BeginHttp2();
  for (std::uint32_t i = 0; i < 5'000; ++i) {
    connection.SendCall(2 * i + 1, "/capfit.v1.BodyApproximationService/ApproximateBody");
    connection.SendFrame(FrameType::kResetStream, 2 * i + 1, std::string("\0\0\0\x08", 4));
  }
  EXPECT_TRUE(AskInfo(*server, {}).ok());
}

TEST(ConnectionLimits, TooMuchMetadataIsRefused) {
  const auto server = StartSecured({});
  const auto stub = StubOf(*server);
  for (const std::size_t bytes : {std::size_t{1'000'000}, std::size_t{20'000}}) {
    grpc::ClientContext context;
    context.AddMetadata("bomb", std::string(bytes, 'x'));
    v1::GetServerInfoResponse info;
    // UNAVAILABLE where the connection ends before the client has sent it all.
    EXPECT_THAT(
        stub->GetServerInfo(&context, {}, &info).error_code(),
        testing::AnyOf(grpc::StatusCode::RESOURCE_EXHAUSTED, grpc::StatusCode::UNAVAILABLE));
  }
  EXPECT_TRUE(AskInfo(*server, {}).ok());
}

TEST(ConnectionLimits, CallsThatAreCancelledAtOnceAreHarmless) {
  const auto server = StartSecured({});
  const auto stub = StubOf(*server);
  for (int i = 0; i < 2'000; ++i) {
    grpc::ClientContext context;
    const auto stream = stub->ApproximateBody(&context);
    context.TryCancel();
    EXPECT_FALSE(stream->Finish().ok());
  }
  EXPECT_TRUE(Soon([&] { return AskInfo(*server, {}).ok(); }));
}

TEST(ConnectionLimits, AnOldConnectionIsLeftWithoutAnError) {
  ServerConfig config;
  config.connection.max_age_seconds = 1.0;
  const auto server = StartSecured(config);
  const auto stub = StubOf(*server);
  const auto ask = [&] {
    grpc::ClientContext context;
    context.set_wait_for_ready(true);
    v1::GetServerInfoResponse info;
    EXPECT_TRUE(stub->GetServerInfo(&context, {}, &info).ok());
  };
  for (int i = 0; i < 60; ++i) {
    ask();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

TEST(Exposure, OnlyProtectedOrToldServersAreOpenToOthers) {
  for (const char* const address : {"127.0.0.1:7", "localhost:7", "[::1]:7", "unix:/run/capfit"}) {
    EXPECT_TRUE(IsLoopback(address)) << address;
  }
  ServerConfig config;
  for (const char* const address : {"0.0.0.0:7", "[::]:7", "192.0.2.7:7", "capfit:7"}) {
    config.listen = address;
    EXPECT_TRUE(absl::IsFailedPrecondition(CheckExposure(config))) << address;
  }
  config.insecure_listen = true;
  EXPECT_TRUE(CheckExposure(config).ok());
  config.insecure_listen = false;
  config.token_file = "tokens";
  EXPECT_TRUE(CheckExposure(config).ok());
}

}  // namespace
}  // namespace capfit::server
