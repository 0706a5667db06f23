// Tokens: the file, and calls with and without them over real sockets.
#include "server/token_file.h"

#include <gmock/gmock.h>
#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"
#include "capfit/v1/service.grpc.pb.h"
#include "core/base/status.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "tests/server/certificates.h"
#include "tests/server/secured_server.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

// printf %s open-sesame | sha256sum, and of "second".
constexpr char kSesame[] = "d7ecdf25eaf3deba0f2628771dbdd22d4138ab6cf38f91ed02a2ca0dec7c8ab7";
constexpr char kSecond[] = "16367aacb67a4a017c8da8ab95682ccb390863780f7114dda0a0e0c55644c7c4";

std::string Line(const std::string& name, const std::string& hash, const std::string& rest = "") {
  return name + " " + hash + " " + rest + "\n";
}

client::Security Bearing(const std::string& token) {
  client::Security security;
  security.token = token;
  return security;
}

std::unique_ptr<Server> StartWith(const std::string& tokens) {
  ServerConfig config;
  config.token_file = WriteTestFile("tokens", tokens);
  return StartSecured(config);
}

TEST(ParseTokens, TakesNamesHashesAndDays) {
  const auto tokens = ParseTokens(
      "# who may call\n\n" + Line("anna", kSesame) + Line("ben", kSecond, "expires=2031-05-01"),
      "F");
  ASSERT_TRUE(tokens.ok()) << tokens.status();
  ASSERT_EQ(tokens->size(), 2U);
  EXPECT_EQ((*tokens)[0].name, "anna");
  EXPECT_EQ((*tokens)[0].sha256[0], 0xd7);
  EXPECT_EQ((*tokens)[0].expires, absl::InfiniteFuture());
  EXPECT_EQ((*tokens)[1].expires, absl::FromUnixSeconds(1935360000));
}

TEST(ParseTokens, NamesTheWrongLine) {
  for (const auto& [text, problem] : std::vector<std::pair<std::string, std::string>>{
           {"anna\n", "F line 1 must go on with the SHA-256"},
           {"\nanna 12ab\n", "F line 2 must go on with the SHA-256"},
           {Line("an/na", kSesame), "F line 1 has a name that must be"},
           {Line("anna", kSesame, "expires=soon"), "has 'expires=soon', may only have expires="},
           {Line("anna", kSesame, "admin"), "has 'admin'"}}) {
    const absl::Status status = ParseTokens(text, "F").status();
    EXPECT_THAT(std::string(status.message()), HasSubstr(problem));
  }
}

TEST(TokenFile, OnlyKnownTokensGetThrough) {
  const auto server = StartWith(Line("anna", kSesame) + Line("old", kSecond, "expires=2001-01-01"));
  EXPECT_TRUE(AskInfo(*server, Bearing("open-sesame")).ok());
  for (const char* const token : {"", "wrong", "open-sesame ", "second", kSesame}) {
    const absl::Status status = AskInfo(*server, Bearing(token));
    EXPECT_EQ(status.code(), absl::StatusCode::kUnauthenticated) << token;
    EXPECT_EQ(ReasonOf(status), ErrorReason::kUnauthenticated) << token;
  }
  EXPECT_THAT(std::string(AskInfo(*server, {}).message()),
              HasSubstr("authorization: Bearer TOKEN"));
}

TEST(TokenFile, EveryCallOfTheServiceAsksForOneAndHealthDoesNot) {
  const auto server = StartWith(Line("anna", kSesame));
  const auto channel = server->InProcessChannel();
  const client::BodyClient client(channel);
  EXPECT_EQ(client.ApproximateMesh({}, {}).status().code(), absl::StatusCode::kUnauthenticated);
  const auto stub = v1::BodyApproximationService::NewStub(channel);
  grpc::ClientContext unary;
  v1::ApproximateBodyUnaryResponse answer;
  EXPECT_EQ(stub->ApproximateBodyUnary(&unary, {}, &answer).error_code(),
            grpc::StatusCode::UNAUTHENTICATED);
  grpc::ClientContext context;
  grpc::health::v1::HealthCheckResponse health;
  EXPECT_TRUE(grpc::health::v1::Health::NewStub(channel)->Check(&context, {}, &health).ok());
  for (const char* const method : {"ApproximateBody", "ApproximateBodyUnary"}) {
    EXPECT_THAT(server->MetricsText(),
                HasSubstr(absl::StrCat("capfit_calls_total{code=\"UNAUTHENTICATED\",method=\"",
                                       method, "\"} 1")));
  }
}

TEST(TokenFile, ChangesHoldWithinASecondAndWrongFilesChangeNothing) {
  const auto server = StartWith(Line("anna", kSesame));
  WriteTestFile("tokens", Line("ben", kSecond));
  EXPECT_TRUE(Soon([&] { return AskInfo(*server, Bearing("second")).ok(); }));
  EXPECT_TRUE(absl::IsUnauthenticated(AskInfo(*server, Bearing("open-sesame"))));
  WriteTestFile("tokens", "half a li");
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  EXPECT_TRUE(AskInfo(*server, Bearing("second")).ok());
  WriteTestFile("tokens", "# nobody\n");
  EXPECT_TRUE(Soon([&] { return absl::IsUnauthenticated(AskInfo(*server, Bearing("second"))); }));
}

TEST(TokenFile, TenThousandWrongOnesAreRefusedAndOthersServed) {
  const auto server = StartWith(Line("anna", kSesame));
  const auto attack = [&] {
    const auto stub = v1::BodyApproximationService::NewStub(grpc::CreateChannel(
        "127.0.0.1:" + std::to_string(server->port()), grpc::InsecureChannelCredentials()));
    int refused = 0;
    for (int i = 0; i < 2'500; ++i) {
      grpc::ClientContext context;
      context.AddMetadata("authorization", "Bearer guess" + std::to_string(i));
      v1::GetServerInfoResponse info;
      const grpc::Status status = stub->GetServerInfo(&context, {}, &info);
      if (status.error_code() == grpc::StatusCode::UNAUTHENTICATED) ++refused;
    }
    EXPECT_EQ(refused, 2'500);
  };
  std::vector<std::thread> attackers;
  for (int i = 0; i < 4; ++i) attackers.emplace_back(attack);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(AskInfo(*server, Bearing("open-sesame")).ok());
  for (std::thread& attacker : attackers) attacker.join();
}

}  // namespace
}  // namespace capfit::server
