// Certificates for tests, made on the spot.
#ifndef CAPFIT_TESTS_SERVER_CERTIFICATES_H_
#define CAPFIT_TESTS_SERVER_CERTIFICATES_H_

#include <string>

namespace capfit::server {

struct CertificateAndKey {
  std::string certificate;  // PEM, as the key
  std::string key;
};

// Who signs others; valid for an hour.
[[nodiscard]] CertificateAndKey MakeAuthority(const std::string& name);

// For localhost and 127.0.0.1, signed by `authority`; times in seconds from now.
[[nodiscard]] CertificateAndKey MakeCertificate(const CertificateAndKey& authority,
                                                long valid_from_seconds = -60,
                                                long valid_to_seconds = 3600);

// Writes a file below the folder for tests and gives its path.
std::string WriteTestFile(const std::string& name, const std::string& text);

}  // namespace capfit::server

#endif  // CAPFIT_TESTS_SERVER_CERTIFICATES_H_
