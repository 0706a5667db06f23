#include "core/base/plain_text.h"

#include <nlohmann/json.hpp>

namespace capfit {
namespace {

constexpr std::size_t kLongestLetter = 4;  // in bytes of UTF-8

bool IsWithinLetter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u; }

// U+0000 to U+001F, U+007F to U+009F, U+2028 to U+202E and U+2066 to U+2069.
bool IsControl(std::string_view letter) {
  const auto byte = [&](std::size_t i) {
    return i < letter.size() ? static_cast<unsigned char>(letter[i]) : 0u;
  };
  if (byte(0) < 0x20 || byte(0) == 0x7F) return true;
  if (byte(0) == 0xC2) return byte(1) < 0xA0;
  if (byte(0) != 0xE2) return false;
  return (byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE) ||
         (byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9);
}

// visit(letter) for those of valid UTF-8, in order, until it returns false.
template <typename Visit>
void VisitLetters(std::string_view valid, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < valid.size(); begin = end) {
    end = begin + 1;
    while (end < valid.size() && IsWithinLetter(valid[end])) ++end;
    const std::string_view letter = valid.substr(begin, end - begin);
    if (!visit(IsControl(letter) ? "?" : letter)) return;
  }
}

}  // namespace

std::string ValidUtf8(std::string_view text) {
  using Json = nlohmann::json;
  const std::string quoted =
      Json(std::string(text)).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

std::string PlainText(std::string_view text, std::size_t most_bytes) {
  // A letter at the cut may be broken: it is beyond the limit.
  const std::string valid = ValidUtf8(text.substr(0, most_bytes + kLongestLetter));
  std::string plain;
  VisitLetters(valid, [&](std::string_view letter) {
    if (plain.size() + letter.size() > most_bytes) return false;
    plain += letter;
    return true;
  });
  return plain;
}

std::string ShortPlainText(std::string_view text, std::size_t most_letters) {
  const std::string valid = ValidUtf8(text.substr(0, (most_letters + 1) * kLongestLetter));
  std::string plain;
  std::size_t letters = 0;
  VisitLetters(valid, [&](std::string_view letter) {
    plain += letters == most_letters ? "..." : letter;
    return letters++ < most_letters;
  });
  return plain;
}

}  // namespace capfit
