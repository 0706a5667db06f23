#include "tests/bench/read_body.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/formats/read_mesh.h"

namespace capfit::bench {

absl::StatusOr<formats::PolygonSoup> ReadBody(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return absl::NotFoundError(absl::StrCat("cannot read ", path));
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)), formats::FormatFromFileName(path));
  if (soup.ok()) return soup;
  return absl::Status(soup.status().code(), absl::StrCat(path, ": ", soup.status().message()));
}

formats::PolygonSoup ReadBodyOrExit(const std::string& path) {
  auto soup = ReadBody(path);
  if (soup.ok()) return *std::move(soup);
  std::fprintf(stderr, "%s\n", std::string(soup.status().message()).c_str());
  std::exit(2);
}

}  // namespace capfit::bench
