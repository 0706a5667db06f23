#include "core/skinning/weights_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <istream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::skinning {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kChunkWeights = 1 << 16;
constexpr std::uint64_t kMaxCount = std::numeric_limits<std::int32_t>::max();

static_assert(std::numeric_limits<float>::is_iec559 && sizeof(float) == 4);

// The bytes of one number, least significant first, on any machine.
std::uint32_t LittleEndian(std::uint32_t word) {
  if constexpr (std::endian::native == std::endian::big) return __builtin_bswap32(word);
  return word;
}

absl::Status MissingMember(const std::string& name) {
  return InvalidField(ErrorReason::kMissing, name, "is missing from the weights header");
}

absl::StatusOr<std::string> TextMember(const Json& header, const std::string& name) {
  const auto found = header.find(name);
  if (found == header.end()) return MissingMember(name);
  if (!found->is_string()) return InvalidField(ErrorReason::kMalformedFile, name, "must be a text");
  return found->get<std::string>();
}

absl::Status ExpectText(const Json& header, const std::string& name, const std::string& expected) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, TextMember(header, name));
  if (text == expected) return absl::OkStatus();
  return InvalidField(ErrorReason::kUnsupportedFile, name,
                      absl::StrCat("is \"", text, "\", must be \"", expected, "\""),
                      {{"value", text}, {"limit", expected}});
}

absl::StatusOr<std::uint64_t> CountMember(const Json& header, const std::string& name) {
  const auto found = header.find(name);
  if (found == header.end()) return MissingMember(name);
  if (!found->is_number_unsigned()) {
    return InvalidField(ErrorReason::kMalformedFile, name,
                        absl::StrCat("is ", found->dump(), ", must be a whole number >= 0"));
  }
  const auto count = found->get<std::uint64_t>();
  if (count <= kMaxCount) return count;
  return OutOfRange(name, count, std::uint64_t{0}, kMaxCount);
}

absl::Status CheckKind(const Json& header) {
  CAPFIT_RETURN_IF_ERROR(ExpectText(header, "format", "capfit-dense-weights"));
  CAPFIT_ASSIGN_OR_RETURN(const std::uint64_t version, CountMember(header, "version"));
  if (version != 1) {
    return InvalidField(ErrorReason::kUnsupportedFile, "version",
                        absl::StrCat("is ", version, ", must be 1"),
                        {{"value", absl::StrCat(version)}, {"limit", "1"}});
  }
  CAPFIT_RETURN_IF_ERROR(ExpectText(header, "dtype", "float32"));
  CAPFIT_RETURN_IF_ERROR(ExpectText(header, "byte_order", "little"));
  return ExpectText(header, "layout", "row-major");
}

absl::Status WrongSize(const WeightsHeader& header, const std::string& found) {
  return InvalidField(
      ErrorReason::kCountMismatch, "weights",
      absl::StrCat("hold ", found, " bytes, must hold ", header.data_bytes(), " (",
                   header.sphere_count, " spheres x ", header.vertex_count, " vertices x 4)"),
      {{"value", found}, {"limit", absl::StrCat(header.data_bytes())}});
}

// Index of the first number that is not finite.
std::optional<std::size_t> FirstNotFinite(const std::vector<float>& weights) {
  const auto found = std::find_if(weights.begin(), weights.end(),
                                  [](float weight) { return !std::isfinite(weight); });
  if (found == weights.end()) return std::nullopt;
  return static_cast<std::size_t>(found - weights.begin());
}

}  // namespace

std::string FormatWeightsHeader(const DenseWeights& weights, const std::string& data_file) {
  nlohmann::ordered_json header;
  header["format"] = "capfit-dense-weights";
  header["version"] = 1;
  header["dtype"] = "float32";
  header["byte_order"] = "little";
  header["layout"] = "row-major";
  header["spheres"] = weights.sphere_count;
  header["vertices"] = weights.vertex_count;
  header["data"] = data_file;
  // A file name may hold bytes that are not UTF-8; they are replaced rather than thrown over.
  return header.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

absl::StatusOr<WeightsHeader> ParseWeightsHeader(const std::string& text) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded() || !json.is_object()) {
    return InvalidField(ErrorReason::kMalformedFile, "header", "must be one JSON object");
  }
  CAPFIT_RETURN_IF_ERROR(CheckKind(json));
  CAPFIT_ASSIGN_OR_RETURN(const std::uint64_t spheres, CountMember(json, "spheres"));
  CAPFIT_ASSIGN_OR_RETURN(const std::uint64_t vertices, CountMember(json, "vertices"));
  CAPFIT_ASSIGN_OR_RETURN(const std::string data_file, TextMember(json, "data"));
  WeightsHeader header{spheres, vertices, data_file};
  if (spheres != 0 && vertices > kMaxWeightsBytes / 4 / spheres) {
    return InvalidField(ErrorReason::kTooLarge, "spheres * vertices * 4",
                        absl::StrCat("is more than ", kMaxWeightsBytes, " bytes"),
                        {{"limit", absl::StrCat(kMaxWeightsBytes)}});
  }
  return header;
}

absl::Status WriteWeightsData(const DenseWeights& weights, std::ostream& out) {
  std::vector<std::uint32_t> words;
  for (std::size_t begin = 0; begin < weights.weights.size(); begin += kChunkWeights) {
    const std::size_t count = std::min(kChunkWeights, weights.weights.size() - begin);
    words.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      words[i] = LittleEndian(std::bit_cast<std::uint32_t>(weights.weights[begin + i]));
    }
    out.write(reinterpret_cast<const char*>(words.data()),
              static_cast<std::streamsize>(count * sizeof(std::uint32_t)));
  }
  out.flush();
  if (out.good()) return absl::OkStatus();
  return absl::DataLossError("the weights could not be written completely");
}

absl::StatusOr<DenseWeights> ReadWeightsData(const WeightsHeader& header, std::istream& in) {
  DenseWeights result{header.sphere_count, header.vertex_count, {}};
  const std::size_t total = header.data_bytes() / 4;
  std::vector<std::uint32_t> words;
  // Grows with the bytes that are really there, whatever the header says.
  while (result.weights.size() < total) {
    words.resize(std::min(kChunkWeights, total - result.weights.size()));
    in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    const auto got = static_cast<std::uint64_t>(in.gcount());
    if (got != words.size() * 4) {
      return WrongSize(header, absl::StrCat(result.weights.size() * 4 + got));
    }
    for (const std::uint32_t word : words) {
      result.weights.push_back(std::bit_cast<float>(LittleEndian(word)));
    }
  }
  if (in.peek() != std::istream::traits_type::eof()) return WrongSize(header, "more");
  if (const auto at = FirstNotFinite(result.weights)) {
    return InvalidField(
        ErrorReason::kNotFinite,
        absl::StrCat("weights[", *at / header.vertex_count, "][", *at % header.vertex_count, "]"),
        absl::StrCat("is ", result.weights[*at], ", must be finite"),
        {{"value", absl::StrCat(result.weights[*at])}, {"limit", "finite"}});
  }
  return result;
}

}  // namespace capfit::skinning
