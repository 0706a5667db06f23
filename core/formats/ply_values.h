// The numbers in the data of a PLY file, one after the other, never past the end.
#ifndef CAPFIT_CORE_FORMATS_PLY_VALUES_H_
#define CAPFIT_CORE_FORMATS_PLY_VALUES_H_

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "core/formats/file_error.h"
#include "core/formats/ply_header.h"
#include "core/formats/text_scanner.h"

namespace capfit::formats {

static_assert(std::endian::native == std::endian::little, "byte order of the loads below");

template <typename Value, bool kSwap>
[[nodiscard]] double LoadPlyValue(const char* bytes) {
  std::array<char, sizeof(Value)> raw;
  std::memcpy(raw.data(), bytes, sizeof(Value));
  if constexpr (kSwap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<Value>(raw));
}

[[nodiscard]] inline FilePlace AtRecord(const PlyElement& element, std::uint64_t row) {
  const std::string name = Printable(element.name);
  return {absl::StrCat("element '", name, "' row ", row),
          {{"element", name}, {"row", absl::StrCat(row)}}};
}

// Values of a binary body. A double holds every value of every PLY type exactly.
template <bool kSwap>
class BinaryValues {
 public:
  BinaryValues(const PlyHeader& header, std::string_view file)
      : bytes_(file.substr(header.size_bytes)) {}

  std::optional<double> Next(PlyType type) {
    const std::size_t size = SizeOf(type);
    if (bytes_.size() < size) return std::nullopt;
    const char* const data = bytes_.data();
    bytes_.remove_prefix(size);
    switch (type) {
      case PlyType::kInt8:
        return LoadPlyValue<std::int8_t, kSwap>(data);
      case PlyType::kUint8:
        return LoadPlyValue<std::uint8_t, kSwap>(data);
      case PlyType::kInt16:
        return LoadPlyValue<std::int16_t, kSwap>(data);
      case PlyType::kUint16:
        return LoadPlyValue<std::uint16_t, kSwap>(data);
      case PlyType::kInt32:
        return LoadPlyValue<std::int32_t, kSwap>(data);
      case PlyType::kUint32:
        return LoadPlyValue<std::uint32_t, kSwap>(data);
      case PlyType::kFloat32:
        return LoadPlyValue<float, kSwap>(data);
      case PlyType::kFloat64:
        return LoadPlyValue<double, kSwap>(data);
    }
    return std::nullopt;
  }
  [[nodiscard]] std::size_t BytesLeft() const { return bytes_.size(); }
  [[nodiscard]] FilePlace Place(const PlyElement& element, std::uint64_t row) const {
    return AtRecord(element, row);
  }
  // The word in which Next() found no number; empty where the file has ended.
  [[nodiscard]] static std::string_view BadWord() { return {}; }

 private:
  std::string_view bytes_;
};

// Values of a text body.
class TextValues {
 public:
  TextValues(const PlyHeader& header, std::string_view file)
      : body_(file.substr(header.size_bytes)), words_(body_), lines_before_(header.lines) {}

  std::optional<double> Next(PlyType) {
    word_ = words_.NextWord();
    return ParseNumber<double>(word_);
  }
  [[nodiscard]] std::size_t BytesLeft() const { return words_.Rest().size(); }
  // The line of the last word. A record may take several, so they are counted when asked for.
  [[nodiscard]] FilePlace Place(const PlyElement&, std::uint64_t) const {
    return AtLine(lines_before_ + LineOf(body_, word_.empty() ? LastCharacter() : word_));
  }
  [[nodiscard]] std::string_view BadWord() const { return word_; }

 private:
  // The last that is not blank.
  [[nodiscard]] std::string_view LastCharacter() const {
    std::size_t size = body_.size();
    while (size > 1 && WordScanner::IsBlank(body_[size - 1])) --size;
    return body_.substr(size - std::min<std::size_t>(size, 1));
  }

  std::string_view body_;
  WordScanner words_;
  std::string_view word_;
  std::size_t lines_before_;
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_PLY_VALUES_H_
