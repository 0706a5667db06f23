// TLS over real sockets: who gets through, who does not, and new certificates.
#include "server/tls_credentials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/server_flags.h"
#include "tests/server/certificates.h"
#include "tests/server/secured_server.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

// Files of one server and what its clients need to know.
struct Identity {
  explicit Identity(const std::string& name)
      : authority(MakeAuthority(name)), server(MakeCertificate(authority)) {
    config.tls.certificate_file = WriteTestFile(name + ".pem", server.certificate);
    config.tls.key_file = WriteTestFile(name + ".key", server.key);
    security.tls = true;
    security.root_certificates = authority.certificate;
  }
  CertificateAndKey authority;
  CertificateAndKey server;
  ServerConfig config;
  client::Security security;
};

std::string MessageOf(const ServerConfig& config) {
  return std::string(CheckConfig(config).message());
}

TEST(TlsCredentials, WhoTrustsTheAuthorityGetsThrough) {
  const Identity identity("good");
  const auto server = StartSecured(identity.config);
  EXPECT_TRUE(AskInfo(*server, identity.security).ok());
}

TEST(TlsCredentials, PlainAndMistrustingClientsDoNotAndOthersDo) {
  const Identity identity("strict");
  const auto server = StartSecured(identity.config);
  EXPECT_EQ(AskInfo(*server, {}).code(), absl::StatusCode::kUnavailable);
  client::Security other = identity.security;
  other.root_certificates = MakeAuthority("other").certificate;
  EXPECT_EQ(AskInfo(*server, other).code(), absl::StatusCode::kUnavailable);
  EXPECT_TRUE(AskInfo(*server, identity.security).ok());
}

TEST(TlsCredentials, AClientCertificateMustBeOfItsAuthorityAndInTime) {
  Identity identity("mutual");
  const CertificateAndKey clients = MakeAuthority("clients");
  identity.config.tls.client_ca_file = WriteTestFile("clients.pem", clients.certificate);
  const auto server = StartSecured(identity.config);
  const auto ask = [&](const CertificateAndKey& pair) {
    client::Security security = identity.security;
    security.certificate = pair.certificate;
    security.key = pair.key;
    return AskInfo(*server, security);
  };
  EXPECT_EQ(ask({}).code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(ask(MakeCertificate(identity.authority)).code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(ask(MakeCertificate(clients, -7200, -3600)).code(), absl::StatusCode::kUnavailable);
  EXPECT_TRUE(ask(MakeCertificate(clients)).ok());
}

TEST(TlsCredentials, NewFilesHoldForNewConnectionsAndWrongOnesChangeNothing) {
  const Identity identity("renewed");
  const auto server = StartSecured(identity.config);
  const auto running =
      client::BodyClient::Connect("127.0.0.1:" + std::to_string(server->port()), identity.security);
  ASSERT_TRUE(running->GetServerInfo().ok());
  // A key that belongs to another certificate: the former pair stays.
  const CertificateAndKey authority = MakeAuthority("next");
  const CertificateAndKey next = MakeCertificate(authority);
  WriteTestFile("renewed.key", next.key);
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  EXPECT_TRUE(AskInfo(*server, identity.security).ok());
  // Now it belongs.
  WriteTestFile("renewed.pem", next.certificate);
  client::Security security = identity.security;
  security.root_certificates = authority.certificate;
  EXPECT_TRUE(Soon([&] { return AskInfo(*server, security).ok(); }));
  EXPECT_FALSE(AskInfo(*server, identity.security).ok());
  EXPECT_TRUE(running->GetServerInfo().ok());
}

TEST(TlsCredentials, WhenTheCertificateEndsIsAMetricThatFollowsTheFile) {
  const auto expiry = [](const Server& server) {
    constexpr char kName[] = "\ncapfit_certificate_expiry_timestamp_seconds ";
    const std::string text = server.MetricsText();
    const std::size_t at = text.find(kName);
    return at == std::string::npos ? 0.0 : std::atof(text.c_str() + at + sizeof(kName) - 1);
  };
  const double now = absl::ToDoubleSeconds(absl::Now() - absl::UnixEpoch());
  const Identity identity("ends");
  const auto server = StartSecured(identity.config);
  EXPECT_NEAR(expiry(*server), now + 3600.0, 300.0);
  const CertificateAndKey longer = MakeCertificate(identity.authority, -60, 90 * 86'400);
  WriteTestFile("ends.key", longer.key);
  WriteTestFile("ends.pem", longer.certificate);
  EXPECT_TRUE(Soon([&] {
    static_cast<void>(AskInfo(*server, identity.security));
    return expiry(*server) > now + 89 * 86'400.0;
  }));
  EXPECT_EQ(expiry(*StartSecured({})), 0.0) << "no TLS";
}

TEST(TlsFiles, WhatIsWrongIsNamed) {
  const Identity identity("named");
  ServerConfig config = identity.config;
  EXPECT_EQ(MessageOf(config), "");
  config.tls.key_file = WriteTestFile("foreign.key", MakeAuthority("foreign").key);
  EXPECT_THAT(MessageOf(config), HasSubstr("foreign.key is not the key of the certificate in"));
  config.tls.key_file = "";
  EXPECT_THAT(MessageOf(config), HasSubstr("--tls-key is missing"));
  config = identity.config;
  config.tls.certificate_file = WriteTestFile("text.pem", "no PEM");
  EXPECT_THAT(MessageOf(config), HasSubstr("text.pem has no certificate in PEM"));
  const CertificateAndKey old = MakeCertificate(identity.authority, -7200, -3600);
  config.tls.certificate_file = WriteTestFile("old.pem", old.certificate);
  config.tls.key_file = WriteTestFile("old.key", old.key);
  EXPECT_THAT(MessageOf(config), HasSubstr("old.pem expired on "));
  config.tls.certificate_file = "/nowhere.pem";
  EXPECT_THAT(MessageOf(config), HasSubstr("/nowhere.pem cannot be read"));
  config.tls.certificate_file = "";
  EXPECT_THAT(MessageOf(config), HasSubstr("--tls-certificate is missing"));
}

}  // namespace
}  // namespace capfit::server
