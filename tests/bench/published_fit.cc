// The published method as it stands: quality paper, covered by growing alone (the paper's III-D).
// The evaluation's baseline for what better coverage and refining are worth.
//
//   published_fit BODY RESULT.json --max-primitives N [--threads 2]
//
// Fits all parts. RESULT.json has the shape of `capfit approximate`'s.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <string>

#include "absl/status/statusor.h"
#include "client/result_json.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/pipeline/fit.h"
#include "tests/bench/read_body.h"

namespace capfit::bench {
namespace {

struct Arguments {
  std::string body, result;
  int max_primitives = 64;
  int threads = 2;
};

absl::StatusOr<pipeline::FitResult> FitPublished(const Arguments& arguments) {
  const auto soup = ReadBody(arguments.body);
  if (!soup.ok()) return soup.status();
  pipeline::FitOptions options;
  options.max_primitives = arguments.max_primitives;
  options.parts = {true, true, true, true, true, true};
  options.grows_only = true;
  if (const absl::Status status = pipeline::ValidateOptions(options); !status.ok()) return status;
  NullObserver observer;
  return pipeline::Fit(*soup, options, ThreadPool(arguments.threads), observer);
}

int Run(const Arguments& arguments) {
  const absl::StatusOr<pipeline::FitResult> fit = FitPublished(arguments);
  if (!fit.ok()) {
    std::fprintf(stderr, "published_fit: %s\n", fit.status().ToString().c_str());
    return 1;
  }
  std::ofstream file(arguments.result, std::ios::binary);
  file << client::FormatResult(*fit);
  file.close();
  if (file) return 0;
  std::fprintf(stderr, "published_fit: cannot write %s\n", arguments.result.c_str());
  return 1;
}

}  // namespace
}  // namespace capfit::bench

int main(int argc, char** argv) {
  CLI::App app("The published method, covered by growing alone");
  capfit::bench::Arguments arguments;
  app.add_option("BODY", arguments.body, "Mesh file")->required();
  app.add_option("RESULT", arguments.result, "JSON file to write")->required();
  app.add_option("--max-primitives", arguments.max_primitives, "Spheres and cones");
  app.add_option("--threads", arguments.threads, "Threads")->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  return capfit::bench::Run(arguments);
}
