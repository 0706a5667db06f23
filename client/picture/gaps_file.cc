#include "client/picture/gaps_file.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "client/picture/belongs.h"
#include "client/picture/file_bytes.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using GapsHeader = nlohmann::ordered_json;

constexpr char kGapsFormat[] = "capfit-vertex-gaps";

std::string GapsDataPath(const std::string& header_path, const std::string& data_file) {
  return std::filesystem::path(header_path).replace_filename(data_file).string();
}

std::string GapBytes(std::span<const float> gaps) {
  std::string bytes;
  bytes.reserve(4 * gaps.size());
  for (const float gap : gaps) {
    const auto word = std::bit_cast<std::uint32_t>(gap);
    for (const int shift : {0, 8, 16, 24})
      bytes.push_back(static_cast<char>(word >> shift & 0xffu));
  }
  return bytes;
}

std::vector<float> GapsOf(const std::string& bytes) {
  std::vector<float> gaps;
  gaps.reserve(bytes.size() / 4);
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k])) << 8 * k;
    }
    gaps.push_back(std::bit_cast<float>(word));
  }
  return gaps;
}

absl::Status CheckGapsHeader(const GapsHeader& header) {
  if (!header.is_object())
    return InvalidField(ErrorReason::kMalformedFile, "header", "must be one JSON object");
  const GapsHeader expected = {
      {"format", kGapsFormat}, {"version", 1}, {"dtype", "float32"}, {"byte_order", "little"}};
  for (const auto& [name, value] : expected.items()) {
    if (header.contains(name) && header[name] == value) continue;
    return InvalidField(ErrorReason::kMalformedFile, name, absl::StrCat("must be ", value.dump()));
  }
  if (!header.contains("vertices") || !header["vertices"].is_number_unsigned()) {
    return InvalidField(ErrorReason::kMalformedFile, "vertices", "must be a whole number >= 0");
  }
  if (!header.contains("data") || !header["data"].is_string()) {
    return InvalidField(ErrorReason::kMalformedFile, "data", "must be a file name");
  }
  if (!header.contains("metres_per_unit") || !header["metres_per_unit"].is_number() ||
      !(header["metres_per_unit"].get<double>() > 0.0)) {
    return InvalidField(ErrorReason::kMalformedFile, "metres_per_unit", "must be a number > 0");
  }
  return absl::OkStatus();
}

}  // namespace

std::string GapsPath(const std::string& result_path) {
  return std::filesystem::path(result_path).replace_extension(".gaps.json").string();
}

std::vector<std::string> GapsPaths(const std::string& result_path) {
  return {GapsPath(result_path),
          std::filesystem::path(result_path).replace_extension(".gaps.f32").string()};
}

absl::Status WriteVertexGaps(std::span<const float> gaps, double metres_per_unit,
                             const std::string& result_path) {
  const std::filesystem::path data =
      std::filesystem::path(result_path).replace_extension(".gaps.f32");
  const GapsHeader header = {{"format", kGapsFormat},
                             {"version", 1},
                             {"dtype", "float32"},
                             {"byte_order", "little"},
                             {"vertices", gaps.size()},
                             {"metres_per_unit", metres_per_unit},
                             {"data", data.filename().string()}};
  // A file name may hold bytes that are not UTF-8; they are replaced rather than thrown over.
  const std::string text = header.dump(2, ' ', false, GapsHeader::error_handler_t::replace) + "\n";
  CAPFIT_RETURN_IF_ERROR(WriteFileBytes(GapsPath(result_path), text));
  return WriteFileBytes(data.string(), GapBytes(gaps));
}

absl::StatusOr<VertexGaps> ReadVertexGaps(const std::string& header_path) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(header_path));
  const GapsHeader header = GapsHeader::parse(text, nullptr, /*allow_exceptions=*/false);
  CAPFIT_RETURN_IF_ERROR(CheckGapsHeader(header));
  CAPFIT_ASSIGN_OR_RETURN(
      const std::string bytes,
      ReadFileBytes(GapsDataPath(header_path, header["data"].get<std::string>())));
  const auto count = header["vertices"].get<std::uint64_t>();
  if (bytes.size() % 4 != 0 || bytes.size() / 4 != count) {
    return InvalidField(ErrorReason::kMalformedFile, "data",
                        absl::StrCat("holds ", bytes.size(), " bytes, must hold 4 x ", count));
  }
  return VertexGaps{header["metres_per_unit"].get<double>(), GapsOf(bytes)};
}

absl::Status CheckGapsBelong(const VertexGaps& gaps, const ResultSet& result,
                             const formats::PolygonSoup& body) {
  CAPFIT_RETURN_IF_ERROR(CheckVertexCount("gaps", gaps.gaps.size(), body));
  const double expected = result.metres_per_unit.value_or(gaps.metres_per_unit);
  if (std::abs(gaps.metres_per_unit - expected) <= 1e-6 * expected) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kContradictsBody, "gaps",
      absl::StrCat("are in units of ", gaps.metres_per_unit, " m, RESULT in units of ", expected,
                   " m; give the file that was written with RESULT"));
}

}  // namespace capfit::client
