#include "tests/server/certificates.h"

#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <cstdio>
#include <fstream>
#include <memory>

#include "tests/support/scratch.h"

namespace capfit::server {
namespace {

using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Memory = std::unique_ptr<BIO, decltype(&BIO_free_all)>;

std::string TextOf(BIO* memory) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(memory, &data);
  return {data, static_cast<std::size_t>(size)};
}

CertificateAndKey ToPem(X509* certificate, EVP_PKEY* key) {
  const Memory first(BIO_new(BIO_s_mem()), BIO_free_all);
  const Memory second(BIO_new(BIO_s_mem()), BIO_free_all);
  PEM_write_bio_X509(first.get(), certificate);
  PEM_write_bio_PrivateKey(second.get(), key, nullptr, nullptr, 0, nullptr, nullptr);
  return {TextOf(first.get()), TextOf(second.get())};
}

Memory Open(const std::string& pem) {
  return {BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), BIO_free_all};
}

void AddExtension(X509* certificate, int kind, const char* value) {
  X509_EXTENSION* const extension = X509V3_EXT_conf_nid(nullptr, nullptr, kind, value);
  X509_add_ext(certificate, extension, -1);
  X509_EXTENSION_free(extension);
}

Certificate Blank(EVP_PKEY* key, const std::string& name, long from, long to) {
  static long serial = 1;
  Certificate certificate(X509_new(), X509_free);
  X509_set_version(certificate.get(), 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), ++serial);
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), from);
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), to);
  X509_set_pubkey(certificate.get(), key);
  X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate.get()), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
  return certificate;
}

}  // namespace

CertificateAndKey MakeAuthority(const std::string& name) {
  const Key key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const Certificate certificate = Blank(key.get(), name, -60, 3600);
  X509_set_issuer_name(certificate.get(), X509_get_subject_name(certificate.get()));
  AddExtension(certificate.get(), NID_basic_constraints, "critical,CA:TRUE");
  X509_sign(certificate.get(), key.get(), EVP_sha256());
  return ToPem(certificate.get(), key.get());
}

CertificateAndKey MakeCertificate(const CertificateAndKey& authority, long valid_from_seconds,
                                  long valid_to_seconds) {
  const Certificate signer(
      PEM_read_bio_X509(Open(authority.certificate).get(), nullptr, nullptr, nullptr), X509_free);
  const Key signer_key(
      PEM_read_bio_PrivateKey(Open(authority.key).get(), nullptr, nullptr, nullptr), EVP_PKEY_free);
  const Key key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const Certificate certificate =
      Blank(key.get(), "localhost", valid_from_seconds, valid_to_seconds);
  X509_set_issuer_name(certificate.get(), X509_get_subject_name(signer.get()));
  AddExtension(certificate.get(), NID_subject_alt_name, "DNS:localhost,IP:127.0.0.1");
  X509_sign(certificate.get(), signer_key.get(), EVP_sha256());
  return ToPem(certificate.get(), key.get());
}

// Renamed into place, so that nobody reads half a file.
std::string WriteTestFile(const std::string& name, const std::string& text) {
  static const test_support::Scratch scratch;
  const std::string path = scratch.Path(name);
  std::ofstream(path + ".tmp", std::ios::binary) << text;
  EXPECT_EQ(std::rename((path + ".tmp").c_str(), path.c_str()), 0);
  return path;
}

}  // namespace capfit::server
