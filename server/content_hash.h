// SHA-256 of pieces that follow one another.
#ifndef CAPFIT_SERVER_CONTENT_HASH_H_
#define CAPFIT_SERVER_CONTENT_HASH_H_

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace capfit::server {

// Each piece is hashed with its length, so that other cuts of the same bytes give another hash.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();

  void Add(std::span<const std::byte> piece);
  void Add(const std::string& piece) { Add(std::as_bytes(std::span(piece))); }
  template <typename Number>
  void Add(const std::vector<Number>& piece) {
    Add(std::as_bytes(std::span(piece)));
  }
  // 32 bytes. Once, at the end.
  [[nodiscard]] std::string Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_CONTENT_HASH_H_
