#include "core/formats/ply_header.h"

#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/formats/file_error.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {
namespace {

// More than any exporter writes; keeps hostile headers cheap.
constexpr std::size_t kMaxElements = 32;
constexpr std::size_t kMaxProperties = 256;

std::optional<PlyType> ParseType(std::string_view word) {
  if (word == "char" || word == "int8") return PlyType::kInt8;
  if (word == "uchar" || word == "uint8") return PlyType::kUint8;
  if (word == "short" || word == "int16") return PlyType::kInt16;
  if (word == "ushort" || word == "uint16") return PlyType::kUint16;
  if (word == "int" || word == "int32") return PlyType::kInt32;
  if (word == "uint" || word == "uint32") return PlyType::kUint32;
  if (word == "float" || word == "float32") return PlyType::kFloat32;
  if (word == "double" || word == "float64") return PlyType::kFloat64;
  return std::nullopt;
}

constexpr char kEncodings[] = "ascii, binary_little_endian, binary_big_endian";

std::optional<PlyEncoding> ParseEncoding(std::string_view word) {
  if (word == "ascii") return PlyEncoding::kText;
  if (word == "binary_little_endian") return PlyEncoding::kLittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::kBigEndian;
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view text) : text_(text), lines_(text) {}

  absl::StatusOr<PlyHeader> Run() {
    if (lines_.AtEnd() || WordScanner(lines_.NextLine()).NextWord() != "ply") {
      return Malformed("a PLY file begins with the line 'ply'");
    }
    while (!lines_.AtEnd()) {
      WordScanner words(lines_.NextLine());
      const std::string_view keyword = words.NextWord();
      if (keyword == "end_header") return Finish();
      CAPFIT_RETURN_IF_ERROR(ReadLine(keyword, words));
    }
    return Malformed("the file ends before 'end_header'");
  }

 private:
  absl::StatusOr<PlyHeader> Finish() {
    if (!has_format_) return Malformed("the header has no 'format' line");
    header_.size_bytes = text_.size() - lines_.Rest().size();
    header_.lines = lines_.number();
    return std::move(header_);
  }

  absl::Status ReadLine(std::string_view keyword, WordScanner words) {
    if (keyword == "format") return ReadFormat(words);
    if (keyword == "element") return ReadElement(words);
    if (keyword == "property") return ReadProperty(words);
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return absl::OkStatus();
    return Malformed("unknown keyword in the header");
  }

  absl::Status ReadFormat(WordScanner words) {
    if (has_format_) return Malformed("the header has two 'format' lines");
    const std::string_view word = words.NextWord();
    const std::optional<PlyEncoding> encoding = ParseEncoding(word);
    if (!encoding.has_value()) {
      return FileError(
          ErrorReason::kUnsupportedFile, Here(),
          absl::StrCat("the format is ", Quoted(word), ", must be one of ", kEncodings),
          ValueAndLimit(Printable(word), kEncodings));
    }
    header_.encoding = *encoding;
    has_format_ = true;
    return absl::OkStatus();
  }

  absl::Status ReadElement(WordScanner words) {
    PlyElement element;
    element.name = words.NextWord();
    const std::optional<std::uint64_t> count = ParseNumber<std::uint64_t>(words.NextWord());
    if (element.name.empty() || !count.has_value()) return Malformed("bad 'element' line");
    if (header_.elements.size() >= kMaxElements) {
      return FileTooLarge(Here(), kMaxElements + 1, "elements", kMaxElements);
    }
    element.count = *count;
    header_.elements.push_back(std::move(element));
    return absl::OkStatus();
  }

  absl::Status ReadProperty(WordScanner words) {
    if (header_.elements.empty()) return Malformed("'property' comes before 'element'");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (properties.size() >= kMaxProperties) {
      return FileTooLarge(Here(), kMaxProperties + 1, "properties of one element", kMaxProperties);
    }
    PlyProperty property;
    std::string_view word = words.NextWord();
    if (word == "list") {
      property.is_list = true;
      const std::optional<PlyType> count_type = ParseType(words.NextWord());
      if (!count_type.has_value() || *count_type >= PlyType::kFloat32) {
        return Malformed("bad type of a list's length");
      }
      property.count_type = *count_type;
      word = words.NextWord();
    }
    const std::optional<PlyType> type = ParseType(word);
    property.name = words.NextWord();
    if (!type.has_value() || property.name.empty()) return Malformed("bad 'property' line");
    property.type = *type;
    properties.push_back(std::move(property));
    return absl::OkStatus();
  }

  [[nodiscard]] FilePlace Here() const { return AtLine(lines_.number()); }
  absl::Status Malformed(const std::string& problem) const {
    return FileError(ErrorReason::kMalformedFile, Here(), problem);
  }

  std::string_view text_;
  LineScanner lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

std::size_t SizeOf(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 8;
}

std::uint64_t PlyHeader::vertex_count() const {
  for (const PlyElement& element : elements) {
    const bool has_data = element.count > 0 && !element.properties.empty();
    if (has_data && element.name == "vertex") return element.count;
  }
  return 0;
}

absl::StatusOr<PlyHeader> ReadPlyHeader(std::string_view text) { return HeaderReader(text).Run(); }

std::size_t MinimumBytes(const PlyElement& element, PlyEncoding encoding) {
  // In text each value takes a character, and each but the file's last one a separator.
  if (encoding == PlyEncoding::kText) return 2 * element.properties.size();
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += SizeOf(property.is_list ? property.count_type : property.type);
  }
  return bytes;
}

}  // namespace capfit::formats
