// What the log says of a call: whom it is counted for, by tokens and certificates over real
// sockets, and how large its body is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <span>
#include <sstream>
#include <string>

#include "tests/server/certificates.h"
#include "tests/server/secured_server.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

// The log of one call by a client with this identity. `call` is asked to make it.
std::string LogOf(const ServerConfig& config, const client::Security& security,
                  const std::function<void(const client::BodyClient&)>& call) {
  std::ostringstream log;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  {
    const auto server = StartSecured(config);
    const auto client =
        client::BodyClient::Connect("127.0.0.1:" + std::to_string(server->port()), security);
    call(*client);
  }
  spdlog::set_default_logger(before);
  return log.str();
}

std::string LogOfACall(const ServerConfig& config, const client::Security& security) {
  return LogOf(config, security, [](const client::BodyClient& client) {
    formats::PolygonSoup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    soup.face_vertices = {0, 1, 2};
    EXPECT_TRUE(client.ApproximateMesh(soup, {}).ok());
  });
}

TEST(ClientOf, IsTheTokensNameTheCertificatesNameOrTheHost) {
  ServerConfig open;
  EXPECT_THAT(LogOfACall(open, {}), HasSubstr("client=\"127.0.0.1\""));
  // printf %s open-sesame | sha256sum
  ServerConfig with_token;
  with_token.token_file = WriteTestFile(
      "identity_tokens", "anna d7ecdf25eaf3deba0f2628771dbdd22d4138ab6cf38f91ed02a2ca0dec7c8ab7\n");
  client::Security token;
  token.token = "open-sesame";
  const std::string line = LogOfACall(with_token, token);
  EXPECT_THAT(line, HasSubstr("client=\"token/anna\""));
  EXPECT_THAT(line, testing::Not(HasSubstr("open-sesame")));
  const CertificateAndKey authority = MakeAuthority("identity");
  const CertificateAndKey of_server = MakeCertificate(authority);
  const CertificateAndKey of_client = MakeCertificate(authority);
  ServerConfig with_tls;
  with_tls.tls = {WriteTestFile("identity.pem", of_server.certificate),
                  WriteTestFile("identity.key", of_server.key),
                  WriteTestFile("identity_ca.pem", authority.certificate)};
  client::Security certificate;
  certificate.tls = true;
  certificate.root_certificates = authority.certificate;
  certificate.certificate = of_client.certificate;
  certificate.key = of_client.key;
  EXPECT_THAT(LogOfACall(with_tls, certificate), HasSubstr("client=\"x509_"));
  // Of both the token counts: it names who calls, the certificate a machine.
  with_tls.token_file = with_token.token_file;
  certificate.token = token.token;
  EXPECT_THAT(LogOfACall(with_tls, certificate), HasSubstr("client=\"token/anna\""));
}

// Its size alone would tell a dozen.
TEST(CallLog, CountsTheFacesOfAFileThatWasRead) {
  const std::string file = "# " + std::string(500, '-') + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string line = LogOf({}, {}, [&](const client::BodyClient& client) {
    const auto result =
        client.ApproximateFile(std::as_bytes(std::span(file)), formats::MeshFormat::kObj, {});
    EXPECT_TRUE(result.ok()) << result.status();
  });
  EXPECT_THAT(line, HasSubstr(" faces=1 "));
}

}  // namespace
}  // namespace capfit::server
