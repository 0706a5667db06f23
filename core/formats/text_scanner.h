// A cursor over untrusted text: lines, words and numbers, never past the end.
#ifndef CAPFIT_CORE_FORMATS_TEXT_SCANNER_H_
#define CAPFIT_CORE_FORMATS_TEXT_SCANNER_H_

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

namespace capfit::formats {

// The bytes as text; nothing is copied.
[[nodiscard]] inline std::string_view AsText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The words of one piece of text, one after the other.
class WordScanner {
 public:
  explicit WordScanner(std::string_view text) : text_(text) {}

  // The next run of non-blank characters; empty at the end.
  [[nodiscard]] std::string_view NextWord() {
    std::size_t begin = 0;
    while (begin < text_.size() && IsBlank(text_[begin])) ++begin;
    std::size_t end = begin;
    while (end < text_.size() && !IsBlank(text_[end])) ++end;
    const std::string_view word = text_.substr(begin, end - begin);
    text_.remove_prefix(end);
    return word;
  }
  // What has not been scanned yet.
  [[nodiscard]] std::string_view Rest() const { return text_; }

  // Line ends count as blanks, so that a scanner may also run over many lines.
  [[nodiscard]] static bool IsBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
  }

 private:
  std::string_view text_;
};

// The lines of a text, without their ends (LF or CRLF), counted from 1.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : text_(text) {}

  [[nodiscard]] bool AtEnd() const { return text_.empty(); }
  // The next line; call only when not AtEnd().
  [[nodiscard]] std::string_view NextLine() {
    const std::size_t end = text_.find('\n');
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number_;
    return line;
  }
  // Number of the line that NextLine() returned last.
  [[nodiscard]] std::size_t number() const { return number_; }
  // What has not been scanned yet.
  [[nodiscard]] std::string_view Rest() const { return text_; }

 private:
  std::string_view text_;
  std::size_t number_ = 0;
};

// The whole of `word` into `value`; the error of std::from_chars where that is no number. Ignores
// the locale.
template <typename Number>
[[nodiscard]] std::errc ParseInto(std::string_view word, Number& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  return result.ptr == end ? result.ec : std::errc::invalid_argument;
}

// The whole of `word` as a number; nothing where it is none or does not fit.
template <typename Number>
[[nodiscard]] std::optional<Number> ParseNumber(std::string_view word) {
  Number value{};
  if (ParseInto(word, value) != std::errc()) return std::nullopt;
  return value;
}

// Whether `word` is a number, but one that does not fit.
template <typename Number>
[[nodiscard]] bool IsNumberThatDoesNotFit(std::string_view word) {
  Number value{};
  return ParseInto(word, value) == std::errc::result_out_of_range;
}

// Number of the line of `text`, counted from 1, in which `part` of it begins.
[[nodiscard]] inline std::size_t LineOf(std::string_view text, std::string_view part) {
  return 1 + static_cast<std::size_t>(std::count(text.data(), part.data(), '\n'));
}

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_TEXT_SCANNER_H_
