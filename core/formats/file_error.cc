#include "core/formats/file_error.h"

#include "core/base/plain_text.h"

namespace capfit::formats {
namespace {

std::string NameOfAxis(int axis) { return {static_cast<char>('x' + axis)}; }

}  // namespace

FilePlace AtLine(std::size_t number) {
  return {absl::StrCat("line ", number), {{"line", absl::StrCat(number)}}};
}

FilePlace AtElement(const std::string& element) { return {element, {{"element", element}}}; }

FilePlace AtRow(const std::string& element, std::uint64_t row) {
  return {absl::StrCat(element, " row ", row), {{"element", element}, {"row", absl::StrCat(row)}}};
}

absl::Status FileError(ErrorReason reason, const FilePlace& place, const std::string& problem,
                       const ErrorFacts& facts) {
  ErrorFacts all = facts;
  all.insert(all.end(), place.facts.begin(), place.facts.end());
  return InvalidField(reason, "mesh.file",
                      place.text.empty() ? problem : absl::StrCat(place.text, ": ", problem), all);
}

absl::Status FileTooLarge(const FilePlace& place, std::uint64_t count, const std::string& what,
                          std::uint64_t limit) {
  if (place.text.empty()) return TooLarge("mesh.file", count, what, limit);
  return FileError(
      ErrorReason::kTooLarge, place,
      absl::StrCat("brings the file to ", count, " ", what, ", must have at most ", limit),
      ValueAndLimit(count, limit));
}

absl::Status TooManyTriangles(const FilePlace& place, const MeshLimits& limits) {
  return FileError(ErrorReason::kTooLarge, place, "the faces " + TooManyTriangles(limits),
                   {{"limit", absl::StrCat(limits.max_triangles())}});
}

std::string Printable(std::string_view word, std::size_t most_characters) {
  return ShortPlainText(word, most_characters);
}

std::string Quoted(std::string_view word) { return absl::StrCat("'", Printable(word), "'"); }

absl::Status BadCoordinate(const FilePlace& place, int axis, double value) {
  const CoordinateProblem problem = ProblemOf(value);
  return FileError(problem.reason, place, absl::StrCat(NameOfAxis(axis), " ", problem.text),
                   problem.facts);
}

absl::Status BadCoordinate(const FilePlace& place, int axis, std::string_view word) {
  const std::optional<double> value = ParseNumber<double>(word);
  if (value.has_value()) return BadCoordinate(place, axis, *value);
  return BadNumber<double>(place, NameOfAxis(axis), word, CoordinateRange());
}

}  // namespace capfit::formats
