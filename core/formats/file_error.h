// What is wrong in a file and where: one shape of error for all formats, with the field
// "mesh.file".
#ifndef CAPFIT_CORE_FORMATS_FILE_ERROR_H_
#define CAPFIT_CORE_FORMATS_FILE_ERROR_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/soup_checks.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {

// A place in a file, as the message names it and as programs read it. Lines count from 1, all else
// from 0.
struct FilePlace {
  std::string text;  // "line 7495"; empty: the file as a whole
  ErrorFacts facts;  // "line", or "element" and "row"
};

[[nodiscard]] FilePlace AtLine(std::size_t number);
// "accessor 3", "node 7": a thing in the file.
[[nodiscard]] FilePlace AtElement(const std::string& element);
// "accessor 3 row 17": one of the many that `element` has.
[[nodiscard]] FilePlace AtRow(const std::string& element, std::uint64_t row);

// INVALID_ARGUMENT "mesh.file <place>: <problem>", or "mesh.file <problem>" for the file as a
// whole.
[[nodiscard]] absl::Status FileError(ErrorReason reason, const FilePlace& place,
                                     const std::string& problem, const ErrorFacts& facts = {});

// The facts "value" and "limit".
template <typename Value, typename Limit>
[[nodiscard]] ErrorFacts ValueAndLimit(const Value& value, const Limit& limit) {
  return {{"value", absl::StrCat(value)}, {"limit", absl::StrCat(limit)}};
}

// "[0, <end>)": what an index may be.
[[nodiscard]] inline std::string IndexRange(std::uint64_t end) {
  return absl::StrCat("[0, ", end, ")");
}

// "<place>: <what> is <value>, must be in <limit>".
template <typename Value>
[[nodiscard]] absl::Status FileOutOfRange(const FilePlace& place, const std::string& what,
                                          const Value& value, const std::string& limit) {
  return FileError(ErrorReason::kOutOfRange, place,
                   absl::StrCat(what, " is ", value, ", must be in ", limit),
                   ValueAndLimit(value, limit));
}

// "<place>: brings the file to <count> <what>, must have at most <limit>", or for the file as a
// whole "has <count> <what>, must have at most <limit>".
[[nodiscard]] absl::Status FileTooLarge(const FilePlace& place, std::uint64_t count,
                                        const std::string& what, std::uint64_t limit);

// Where a TriangleCounter has had enough.
[[nodiscard]] absl::Status TooManyTriangles(const FilePlace& place, const MeshLimits& limits);

// A word of the file as it may stand in a message: short, and plain (see plain_text.h).
[[nodiscard]] std::string Printable(std::string_view word, std::size_t most_characters = 20);
// The same in quotes.
[[nodiscard]] std::string Quoted(std::string_view word);

// A word that should be `what`, a Number, and is not: it is missing, is none, or does not fit;
// `limit` says what it may be.
template <typename Number>
[[nodiscard]] absl::Status BadNumber(const FilePlace& place, const std::string& what,
                                     std::string_view word, const std::string& limit) {
  if (word.empty()) return FileError(ErrorReason::kMalformedFile, place, what + " is missing");
  if (IsNumberThatDoesNotFit<Number>(word)) {
    return FileOutOfRange(place, what, Printable(word), limit);
  }
  const char* const kind = std::is_integral_v<Number> ? "a whole number" : "a number";
  return FileError(ErrorReason::kMalformedFile, place,
                   absl::StrCat(what, " is ", Quoted(word), ", must be ", kind));
}

// A coordinate for which IsCoordinate() does not hold.
[[nodiscard]] absl::Status BadCoordinate(const FilePlace& place, int axis, double value);
// The same where the file has a word that may be no number at all.
[[nodiscard]] absl::Status BadCoordinate(const FilePlace& place, int axis, std::string_view word);

// The next three words of `line` as a position.
[[nodiscard]] inline absl::Status ReadPosition(std::size_t line, WordScanner& words,
                                               Eigen::Vector3d& position) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = words.NextWord();
    const std::optional<double> value = ParseNumber<double>(word);
    if (!value.has_value() || !IsCoordinate(*value)) {
      return BadCoordinate(AtLine(line), axis, word);
    }
    position[axis] = *value;
  }
  return absl::OkStatus();
}

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_FILE_ERROR_H_
