#include "server/tls_files.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <fstream>
#include <iterator>
#include <memory>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::server {
namespace {

template <typename Type, void (*kFree)(Type*)>
struct Freed {
  void operator()(Type* object) const { kFree(object); }
};
using Certificate = std::unique_ptr<X509, Freed<X509, X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY, EVP_PKEY_free>>;
using Memory = std::unique_ptr<BIO, Freed<BIO, BIO_free_all>>;

absl::Status Wrong(const std::string& path, const std::string& problem) {
  ERR_clear_error();
  return InvalidField(ErrorReason::kMalformedFile, path, problem);
}

absl::StatusOr<std::string> ReadFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in.is_open() || in.bad()) return Wrong(path, "cannot be read");
  if (text.empty()) return Wrong(path, "is empty or cannot be read");
  return text;
}

Memory Open(const std::string& pem) {
  return Memory(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
}

absl::StatusOr<Certificate> FirstCertificate(const std::string& pem, const std::string& path) {
  Certificate certificate(PEM_read_bio_X509(Open(pem).get(), nullptr, nullptr, nullptr));
  if (certificate == nullptr) return Wrong(path, "has no certificate in PEM");
  return certificate;
}

std::string Text(const ASN1_TIME* time) {
  const Memory memory(BIO_new(BIO_s_mem()));
  ASN1_TIME_print(memory.get(), time);
  char* data = nullptr;
  const long size = BIO_get_mem_data(memory.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

absl::Status CheckDates(const X509& certificate, const std::string& path) {
  const ASN1_TIME* const begin = X509_get0_notBefore(&certificate);
  const ASN1_TIME* const end = X509_get0_notAfter(&certificate);
  if (X509_cmp_current_time(end) < 0) return Wrong(path, "expired on " + Text(end));
  if (X509_cmp_current_time(begin) > 0) return Wrong(path, "is not valid before " + Text(begin));
  return absl::OkStatus();
}

absl::Time EndOf(const X509& certificate) {
  tm end = {};
  ASN1_TIME_to_tm(X509_get0_notAfter(&certificate), &end);
  return absl::FromTM(end, absl::UTCTimeZone());
}

// A passphrase is never asked for: nobody sits in front of a server.
int NoPassphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* /*data*/) { return 0; }

absl::StatusOr<Key> ReadKey(const std::string& pem, const std::string& path) {
  Key key(PEM_read_bio_PrivateKey(Open(pem).get(), nullptr, NoPassphrase, nullptr));
  if (key == nullptr) return Wrong(path, "has no private key in PEM without a passphrase");
  return key;
}

}  // namespace

absl::StatusOr<TlsPems> ReadTlsPems(const TlsConfig& config) {
  if (config.key_file.empty()) {
    return InvalidField(ErrorReason::kMissing, "--tls-key",
                        "is missing: --tls-certificate needs the key that belongs to it");
  }
  TlsPems pems;
  CAPFIT_ASSIGN_OR_RETURN(pems.certificate, ReadFile(config.certificate_file));
  CAPFIT_ASSIGN_OR_RETURN(pems.key, ReadFile(config.key_file));
  CAPFIT_ASSIGN_OR_RETURN(const Certificate certificate,
                          FirstCertificate(pems.certificate, config.certificate_file));
  CAPFIT_ASSIGN_OR_RETURN(const Key key, ReadKey(pems.key, config.key_file));
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    return Wrong(config.key_file,
                 absl::StrCat("is not the key of the certificate in ", config.certificate_file));
  }
  CAPFIT_RETURN_IF_ERROR(CheckDates(*certificate, config.certificate_file));
  pems.valid_until = EndOf(*certificate);
  if (config.client_ca_file.empty()) return pems;
  CAPFIT_ASSIGN_OR_RETURN(pems.client_ca, ReadFile(config.client_ca_file));
  CAPFIT_ASSIGN_OR_RETURN(const Certificate authority,
                          FirstCertificate(pems.client_ca, config.client_ca_file));
  CAPFIT_RETURN_IF_ERROR(CheckDates(*authority, config.client_ca_file));
  return pems;
}

}  // namespace capfit::server
