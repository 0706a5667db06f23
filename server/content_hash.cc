#include "server/content_hash.h"

#include <openssl/evp.h>

#include <array>
#include <cstdint>

namespace capfit::server {

struct ContentHash::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  State() { EVP_DigestInit_ex(context, EVP_sha256(), nullptr); }
  ~State() { EVP_MD_CTX_free(context); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {}

ContentHash::~ContentHash() = default;

void ContentHash::Add(std::span<const std::byte> piece) {
  const std::uint64_t length = piece.size();
  EVP_DigestUpdate(state_->context, &length, sizeof(length));
  EVP_DigestUpdate(state_->context, piece.data(), piece.size());
}

std::string ContentHash::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  EVP_DigestFinal_ex(state_->context, digest.data(), &size);
  return {digest.begin(), digest.begin() + size};
}

}  // namespace capfit::server
