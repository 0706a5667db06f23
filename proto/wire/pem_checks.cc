#include "proto/wire/pem_checks.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <memory>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::wire {
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

Memory Open(const std::string& pem) {
  return Memory(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
}

absl::StatusOr<Certificate> FirstCertificate(const PemFile& file) {
  Certificate certificate(PEM_read_bio_X509(Open(file.text).get(), nullptr, nullptr, nullptr));
  if (certificate == nullptr) return Wrong(file.path, "has no certificate in PEM");
  return certificate;
}

std::string Text(const ASN1_TIME* time) {
  const Memory memory(BIO_new(BIO_s_mem()));
  ASN1_TIME_print(memory.get(), time);
  char* data = nullptr;
  const long size = BIO_get_mem_data(memory.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

// A passphrase is never asked for: nobody sits in front of a server.
int NoPassphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* /*data*/) { return 0; }

}  // namespace

absl::Status CheckHasCertificate(const PemFile& file) { return FirstCertificate(file).status(); }

absl::StatusOr<absl::Time> ValidUntil(const PemFile& file) {
  CAPFIT_ASSIGN_OR_RETURN(const Certificate certificate, FirstCertificate(file));
  const ASN1_TIME* const begin = X509_get0_notBefore(certificate.get());
  const ASN1_TIME* const end = X509_get0_notAfter(certificate.get());
  if (X509_cmp_current_time(end) < 0) return Wrong(file.path, "expired on " + Text(end));
  if (X509_cmp_current_time(begin) > 0) {
    return Wrong(file.path, "is not valid before " + Text(begin));
  }
  tm until = {};
  ASN1_TIME_to_tm(end, &until);
  return absl::FromTM(until, absl::UTCTimeZone());
}

absl::Status CheckKey(const PemFile& key, const PemFile& certificate) {
  CAPFIT_ASSIGN_OR_RETURN(const Certificate first, FirstCertificate(certificate));
  const Key read(PEM_read_bio_PrivateKey(Open(key.text).get(), nullptr, NoPassphrase, nullptr));
  if (read == nullptr) return Wrong(key.path, "has no private key in PEM without a passphrase");
  if (X509_check_private_key(first.get(), read.get()) == 1) return absl::OkStatus();
  return Wrong(key.path, absl::StrCat("is not the key of the certificate in ", certificate.path));
}

}  // namespace capfit::wire
