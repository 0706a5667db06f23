// Large inputs that are made to be slow, to take much memory or to confuse.
#ifndef CAPFIT_TESTS_BENCH_HOSTILE_CASES_H_
#define CAPFIT_TESTS_BENCH_HOSTILE_CASES_H_

#include <functional>
#include <string>
#include <vector>

#include "core/formats/polygon_soup.h"
#include "core/formats/read_mesh.h"

namespace capfit::bench {

// A file (of 128 MB at most, what the server takes) or, where `bytes` is empty, arrays.
struct HostileInput {
  std::string bytes;
  formats::MeshFormat format = formats::MeshFormat::kUnknown;
  formats::PolygonSoup soup;
};

struct HostileCase {
  const char* name;
  std::function<HostileInput()> make;  // always the same
};

// Arrays of one to two million faces.
[[nodiscard]] std::vector<HostileCase> HostileArrays();
// Files whose headers lie, whose lines do not end, whose scenes repeat themselves.
[[nodiscard]] std::vector<HostileCase> HostileFiles();

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_HOSTILE_CASES_H_
