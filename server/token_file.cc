#include "server/token_file.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::server {
namespace {

constexpr std::size_t kMaxNameLetters = 64;
constexpr std::string_view kScheme = "Bearer ";
constexpr std::string_view kExpires = "expires=";

bool IsName(const std::string& word) {
  return word.size() <= kMaxNameLetters &&
         std::all_of(word.begin(), word.end(), [](unsigned char letter) {
           return std::isalnum(letter) != 0 || letter == '.' || letter == '_' || letter == '-';
         });
}

bool ParseHash(const std::string& word, std::array<unsigned char, 32>& hash) {
  const bool is_hex = std::all_of(word.begin(), word.end(),
                                  [](unsigned char letter) { return std::isxdigit(letter) != 0; });
  if (!is_hex || word.size() != 2 * hash.size()) return false;
  const std::string bytes = absl::HexStringToBytes(word);
  std::copy(bytes.begin(), bytes.end(), hash.begin());
  return true;
}

// What is wrong with a line; "" for nothing.
std::string ParseLine(const std::string& line, KnownToken& token) {
  std::istringstream words(line);
  std::string hash;
  words >> token.name >> hash;
  if (!IsName(token.name)) {
    return absl::StrCat("has a name that must be at most ", kMaxNameLetters,
                        " letters, digits, '.', '_' or '-'");
  }
  if (!ParseHash(hash, token.sha256)) {
    return "must go on with the SHA-256 of the token, 64 hexadecimal digits";
  }
  for (std::string word; words >> word;) {
    std::string problem;
    const bool is_date =
        word.rfind(kExpires, 0) == 0 &&
        absl::ParseTime("%Y-%m-%d", word.substr(kExpires.size()), &token.expires, &problem);
    if (!is_date) return absl::StrCat("has '", word, "', may only have expires=YYYY-MM-DD");
  }
  return "";
}

absl::StatusOr<std::vector<KnownToken>> Read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in.is_open() || in.bad()) {
    return InvalidField(ErrorReason::kMissing, path, "cannot be read");
  }
  return ParseTokens(text, path);
}

absl::Status Unknown(const std::string& problem) {
  return Refused(ErrorReason::kUnauthenticated, problem);
}

}  // namespace

absl::StatusOr<std::vector<KnownToken>> ParseTokens(const std::string& text,
                                                    const std::string& path) {
  std::vector<KnownToken> tokens;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    KnownToken token;
    if (const std::string problem = ParseLine(line, token); !problem.empty()) {
      return InvalidField(ErrorReason::kMalformedFile, absl::StrCat(path, " line ", number),
                          problem, {{"line", absl::StrCat(number)}});
    }
    tokens.push_back(std::move(token));
  }
  return tokens;
}

TokenFile::TokenFile(const std::string& path, std::vector<KnownToken> tokens)
    : path_(path), watch_({path}), tokens_(std::move(tokens)) {}

absl::StatusOr<std::unique_ptr<TokenFile>> TokenFile::Open(const std::string& path) {
  CAPFIT_ASSIGN_OR_RETURN(std::vector<KnownToken> tokens, Read(path));
  if (tokens.empty()) return InvalidField(ErrorReason::kMissing, path, "has no token");
  return std::unique_ptr<TokenFile>(new TokenFile(path, std::move(tokens)));
}

// Hashes are compared, all of them and to their ends: neither the place of the first difference nor
// the line that fits shows in the time.
absl::StatusOr<std::string> TokenFile::NameOf(std::optional<std::string_view> authorization) {
  if (!authorization || authorization->substr(0, kScheme.size()) != kScheme) {
    return Unknown("this server asks for a token: send metadata 'authorization: Bearer TOKEN'");
  }
  const std::string_view presented = authorization->substr(kScheme.size());
  std::array<unsigned char, 32> hash;
  SHA256(reinterpret_cast<const unsigned char*>(presented.data()), presented.size(), hash.data());
  const std::lock_guard lock(mutex_);
  if (watch_.HasChanged()) ReadAgain();
  const KnownToken* found = nullptr;
  for (const KnownToken& token : tokens_) {
    if (CRYPTO_memcmp(token.sha256.data(), hash.data(), hash.size()) == 0) found = &token;
  }
  if (found == nullptr || absl::Now() >= found->expires) {
    return Unknown(
        "the token in metadata 'authorization' is not one of this server's, or has expired");
  }
  return found->name;
}

void TokenFile::ReadAgain() {
  absl::StatusOr<std::vector<KnownToken>> tokens = Read(path_);
  if (!tokens.ok()) {
    spdlog::error("the former tokens hold: {}", std::string(tokens.status().message()));
    return;
  }
  tokens_ = *std::move(tokens);
  spdlog::info("{} tokens read again from {}", tokens_.size(), path_);
}

}  // namespace capfit::server
