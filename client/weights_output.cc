#include "client/weights_output.h"

#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "client/picture/file_bytes.h"
#include "core/base/status.h"
#include "core/skinning/weights_file.h"

namespace capfit::client {
namespace {

constexpr char kHeaderEnding[] = ".weights.json";
constexpr char kDataEnding[] = ".weights.f32";

bool EndsWith(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

std::string WeightsPath(const std::string& result_path) {
  return std::filesystem::path(result_path).replace_extension(kHeaderEnding).string();
}

std::vector<std::string> WeightsPaths(const std::string& result_path) {
  return {WeightsPath(result_path),
          std::filesystem::path(result_path).replace_extension(kDataEnding).string()};
}

absl::Status WriteWeights(const skinning::DenseWeights& weights, const std::string& result_path) {
  const std::filesystem::path data =
      std::filesystem::path(result_path).replace_extension(kDataEnding);
  CAPFIT_RETURN_IF_ERROR(WriteFileBytes(
      WeightsPath(result_path), skinning::FormatWeightsHeader(weights, data.filename().string())));
  std::ofstream out(data, std::ios::binary);
  if (!out) return absl::NotFoundError(absl::StrCat("cannot write ", data.string()));
  const bool is_written = skinning::WriteWeightsData(weights, out).ok();
  out.close();
  return is_written && out ? absl::OkStatus()
                           : absl::NotFoundError(absl::StrCat("cannot write ", data.string()));
}

bool IsWeightsHeader(const std::string& path) { return EndsWith(path, kHeaderEnding); }

absl::StatusOr<skinning::DenseWeights> ReadWeights(const std::string& path) {
  if (path == "-") {
    return absl::NotFoundError("cannot read weights beside standard input: name RESULT.json");
  }
  const std::string header_path = IsWeightsHeader(path) ? path : WeightsPath(path);
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(header_path));
  CAPFIT_ASSIGN_OR_RETURN(const skinning::WeightsHeader header, skinning::ParseWeightsHeader(text));
  const std::filesystem::path data =
      std::filesystem::path(header_path).replace_filename(header.data_file);
  std::ifstream in(data, std::ios::binary);
  if (!in) return absl::NotFoundError(absl::StrCat("cannot read ", data.string()));
  return skinning::ReadWeightsData(header, in);
}

}  // namespace capfit::client
