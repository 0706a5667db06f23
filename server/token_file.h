// Who may call: bearer tokens, of which only the hashes are kept.
#ifndef CAPFIT_SERVER_TOKEN_FILE_H_
#define CAPFIT_SERVER_TOKEN_FILE_H_

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/file_watch.h"

namespace capfit::server {

// One line of the file: `NAME SHA256 [expires=YYYY-MM-DD]`, the SHA-256 of the token in hexadecimal
// digits. The token holds before the named day (UTC).
struct KnownToken {
  std::string name;  // letters, digits, '.', '_', '-'; at most 64
  std::array<unsigned char, 32> sha256;
  absl::Time expires = absl::InfiniteFuture();
};

// The lines of `text`; empty ones and those that begin with # are left out. INVALID_ARGUMENT
// "PATH line 3 ...".
[[nodiscard]] absl::StatusOr<std::vector<KnownToken>> ParseTokens(const std::string& text,
                                                                  const std::string& path);

// Safe from several threads at once.
class TokenFile {
 public:
  // INVALID_ARGUMENT where the file cannot be read, is wrong, or has no token at all.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<TokenFile>> Open(const std::string& path);

  // The name that belongs to the metadata `authorization` of a call, "Bearer TOKEN".
  // UNAUTHENTICATED where it is missing, or its token unknown or out of date. Takes the same time
  // for every wrong token.
  //
  // A file that has changed is read again, within a second. One that is wrong is named in the log
  // and the former tokens hold; one without any token admits nobody.
  [[nodiscard]] absl::StatusOr<std::string> NameOf(std::optional<std::string_view> authorization);

 private:
  TokenFile(const std::string& path, std::vector<KnownToken> tokens);
  void ReadAgain();

  const std::string path_;
  std::mutex mutex_;
  FileWatch watch_;
  std::vector<KnownToken> tokens_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_TOKEN_FILE_H_
