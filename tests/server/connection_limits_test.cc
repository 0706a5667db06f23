// What one connection can do to the others: nothing.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <grpcpp/client_context.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "capfit/v1/service.grpc.pb.h"
#include "client/connection.h"
#include "server/exposure.h"
#include "tests/server/certificates.h"
#include "tests/server/secured_server.h"

namespace capfit::server {
namespace {

int ConnectTo(int port) {
  const int socket_number = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(socket_number, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  return socket_number;
}

// Whether the server closes the connection within `seconds`.
bool IsClosedWithin(int socket_number, int seconds) {
  pollfd wait = {socket_number, POLLIN, 0};
  char bytes[4096];
  while (poll(&wait, 1, seconds * 1000) == 1) {
    if (recv(socket_number, bytes, sizeof bytes, 0) <= 0) return true;
  }
  return false;
}

std::unique_ptr<v1::BodyApproximationService::Stub> StubOf(const Server& server) {
  return v1::BodyApproximationService::NewStub(
      *client::OpenChannel("127.0.0.1:" + std::to_string(server.port()), {}));
}

TEST(ConnectionLimits, ConnectionsThatSayNothingAreClosedAndOthersServed) {
  const auto server = StartSecured({});
  std::vector<int> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(ConnectTo(server->port()));
  EXPECT_TRUE(AskInfo(*server, {}).ok());
  EXPECT_TRUE(IsClosedWithin(silent.front(), 60));
  for (const int socket_number : silent) close(socket_number);
}

TEST(ConnectionLimits, ATlsHandshakeThatIsNeverFinishedStopsNobody) {
  const CertificateAndKey authority = MakeAuthority("slow");
  const CertificateAndKey pair = MakeCertificate(authority);
  ServerConfig config;
  config.tls.certificate_file = WriteTestFile("slow.pem", pair.certificate);
  config.tls.key_file = WriteTestFile("slow.key", pair.key);
  const auto server = StartSecured(config);
  std::vector<int> slow;
  for (int i = 0; i < 100; ++i) {
    slow.push_back(ConnectTo(server->port()));
    EXPECT_EQ(send(slow.back(), "\x16\x03\x01", 3, 0), 3);  // the first bytes of a TLS record
  }
  client::Security security;
  security.root_certificates = authority.certificate;
  EXPECT_TRUE(AskInfo(*server, security).ok());
  for (const int socket_number : slow) close(socket_number);
}

TEST(ConnectionLimits, TooMuchMetadataIsRefused) {
  const auto server = StartSecured({});
  const auto stub = StubOf(*server);
  for (const std::size_t bytes : {std::size_t{1'000'000}, std::size_t{20'000}}) {
    grpc::ClientContext context;
    context.AddMetadata("bomb", std::string(bytes, 'x'));
    v1::GetServerInfoResponse info;
    EXPECT_EQ(stub->GetServerInfo(&context, {}, &info).error_code(),
              grpc::StatusCode::RESOURCE_EXHAUSTED);
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
