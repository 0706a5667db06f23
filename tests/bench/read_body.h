// Bodies from files, for the programs of this folder.
#ifndef CAPFIT_TESTS_BENCH_READ_BODY_H_
#define CAPFIT_TESTS_BENCH_READ_BODY_H_

#include <string>

#include "absl/status/statusor.h"
#include "core/formats/polygon_soup.h"

namespace capfit::bench {

// A file in any of the formats that capfit reads. An error names it.
[[nodiscard]] absl::StatusOr<formats::PolygonSoup> ReadBody(const std::string& path);

// The same for programs that can only give up: says so on stderr and ends the process.
[[nodiscard]] formats::PolygonSoup ReadBodyOrExit(const std::string& path);

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_READ_BODY_H_
