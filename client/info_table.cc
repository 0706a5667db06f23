#include "client/info_table.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/message_json.h"

namespace capfit::client {
namespace {

template <typename... Values>
std::string InfoLine(const char* format, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return std::string(text.data()) + "\n";
}

std::string Mebibytes(std::int64_t bytes) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.4g MiB", static_cast<double>(bytes) / (1 << 20));
  return text.data();
}

std::string LimitsTable(const v1::ServerLimits& limits) {
  const std::vector<std::pair<const char*, std::string>> rows = {
      {"one mesh", Mebibytes(limits.max_upload_bytes())},
      {"one message", Mebibytes(limits.max_message_bytes())},
      {"vertices", absl::StrCat(limits.max_vertices())},
      {"faces", absl::StrCat(limits.max_faces())},
      {"corners of a face", absl::StrCat(limits.max_corners_per_face())},
      {"fits at a time", absl::StrCat(limits.max_concurrent_fits())},
      {"calls that may wait", absl::StrCat(limits.max_queued_fits())},
      {"threads", absl::StrCat(limits.threads())}};
  std::string table = "\nlimits\n";
  for (const auto& [name, value] : rows) {
    table += InfoLine("  %-20s %12s", name, value.c_str());
  }
  return table;
}

std::string FormatsLine(const v1::GetServerInfoResponse& info) {
  std::vector<std::string> words;
  for (const int format : info.formats()) {
    const auto* const value = v1::MeshFileFormat_descriptor()->FindValueByNumber(format);
    if (value != nullptr) words.push_back(EnumWord(*value));
  }
  return absl::StrCat("\nmesh files: ", absl::StrJoin(words, ", "), "\n");
}

std::string EnginesTable(const v1::GetServerInfoResponse& info) {
  std::string table = "\n" + InfoLine("%-16s %8s %9s %7s  %s", "engine", "spheres", "capsules",
                                      "shapes", "capsule");
  const auto limit = [](int count) { return count == 0 ? "-" : absl::StrCat(count); };
  for (const v1::Engine& engine : info.engines()) {
    const auto* const profile =
        v1::CapsuleProfile_descriptor()->FindValueByNumber(engine.profile());
    table += InfoLine("%-16s %8s %9s %7s  %s", engine.name().c_str(),
                      limit(engine.max_spheres()).c_str(), limit(engine.max_capsules()).c_str(),
                      limit(engine.max_shapes()).c_str(),
                      profile == nullptr ? "?" : EnumWord(*profile).c_str());
  }
  return table;
}

std::string LayoutsTable(const v1::GetServerInfoResponse& info) {
  if (info.layouts().empty()) return "";
  std::string table = "\n" + InfoLine("%-16s %8s %9s", "layout", "spheres", "capsules");
  for (const v1::StandardLayout& layout : info.layouts()) {
    table += InfoLine("%-16s %8d %9d", layout.name().c_str(), layout.sphere_count(),
                      layout.capsule_count());
  }
  return table;
}

// "quality.paper" and "quality.tight" on one line.
std::string FeaturesTable(const v1::GetServerInfoResponse& info) {
  std::vector<std::pair<std::string, std::vector<std::string>>> kinds;
  for (const std::string& feature : info.features()) {
    const std::size_t dot = feature.find('.');
    const std::string kind = dot == std::string::npos ? "other" : feature.substr(0, dot);
    if (kinds.empty() || kinds.back().first != kind) kinds.push_back({kind, {}});
    kinds.back().second.push_back(dot == std::string::npos ? feature : feature.substr(dot + 1));
  }
  std::string table = "\nfeatures\n";
  for (const auto& [kind, words] : kinds) {
    table += InfoLine("  %-10s %s", kind.c_str(), absl::StrJoin(words, ", ").c_str());
  }
  return table;
}

}  // namespace

std::string InfoTable(const v1::GetServerInfoResponse& info) {
  return absl::StrCat("capfit-server ", info.version(), "\n") + LimitsTable(info.limits()) +
         FormatsLine(info) + EnginesTable(info) + LayoutsTable(info) + FeaturesTable(info);
}

}  // namespace capfit::client
