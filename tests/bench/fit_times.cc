// Median time of each stage of a fit, for several numbers of threads in the same run.
//
//   fit_times BODY... [--primitives 64...] [--quality paper|balanced|tight] [--fit enclose|best]
//             [--threads 1 2] [--runs 9] [--parts all|chains] [--side-by-side]
//
// --side-by-side: what the machine gives to as many one-threaded fits at once, in the same rounds;
// what one fit gains from its threads is to be held against that.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "CLI/CLI.hpp"
#include "absl/status/statusor.h"
#include "client/option_words.h"
#include "core/base/large_pages.h"
#include "core/pipeline/fit.h"
#include "tests/bench/read_body.h"

namespace {

using capfit::pipeline::FitOptions;
using capfit::pipeline::FitResult;

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// Of whole fits.
double MedianMs(const std::vector<FitResult>& results) {
  std::vector<double> ms;
  for (const FitResult& result : results) ms.push_back(1e3 * result.seconds);
  return Median(std::move(ms));
}

void Print(const std::vector<FitResult>& results) {
  for (std::size_t stage = 0; stage < capfit::kStageCount; ++stage) {
    std::vector<double> ms;
    for (const FitResult& result : results) ms.push_back(1e3 * result.stage_seconds[stage]);
    std::printf(" %8.1f", Median(std::move(ms)));
  }
  std::printf(" %8.1f %8.4f %6.3f\n", MedianMs(results), results[0].metrics.E_r,
              1e3 * results[0].metrics.max_gap_m);
}

struct Task {
  FitOptions options;
  std::vector<int> threads;
  int runs;
  bool has_side_by_side;
};

// A process has one pool as long as it lives.
const capfit::ThreadPool& PoolOf(int threads) {
  static std::map<int, capfit::ThreadPool> pools;
  return pools.try_emplace(threads, threads).first->second;
}

absl::StatusOr<FitResult> FitOn(const capfit::ThreadPool& pool,
                                const capfit::formats::PolygonSoup& soup,
                                const FitOptions& options) {
  capfit::NullObserver observer;
  return capfit::pipeline::Fit(soup, options, pool, observer);
}

// One-threaded fits begun together; how long the slowest of them took, in ms.
double SideBySideMs(int fits, const capfit::formats::PolygonSoup& soup, const FitOptions& options) {
  std::vector<double> ms(fits, 0.0);
  const capfit::ThreadPool& alone = PoolOf(1);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < fits; ++i) {
      threads.emplace_back([&, i] { ms[i] = 1e3 * FitOn(alone, soup, options).value().seconds; });
    }
  }
  return *std::max_element(ms.begin(), ms.end());
}

void PrintSideBySide(int fits, double alone_ms, double together_ms) {
  std::printf("%d fits side by side, a thread each: done in %.1f ms, %.2f times the work of one\n",
              fits, together_ms, fits * alone_ms / together_ms);
}

bool Run(const std::string& body, const Task& task) {
  const capfit::formats::PolygonSoup soup = capfit::bench::ReadBodyOrExit(body);
  std::vector<std::vector<FitResult>> results(task.threads.size());
  std::vector<double> side_by_side_ms;
  const int warm_up = task.runs > 1 ? 1 : 0;
  for (int run = 0; run < task.runs + warm_up; ++run) {
    for (std::size_t t = 0; t < task.threads.size(); ++t) {
      auto result = FitOn(PoolOf(task.threads[t]), soup, task.options);
      if (!result.ok()) {
        std::fprintf(stderr, "%s\n", result.status().ToString().c_str());
        return false;
      }
      if (run >= warm_up) results[t].push_back(*std::move(result));
    }
    if (task.has_side_by_side && run >= warm_up) {
      side_by_side_ms.push_back(SideBySideMs(task.threads.back(), soup, task.options));
    }
  }
  const std::string name = std::filesystem::path(body).stem().string();
  for (std::size_t t = 0; t < task.threads.size(); ++t) {
    std::printf("%-42s %5d %2d", name.c_str(), *task.options.max_primitives, task.threads[t]);
    Print(results[t]);
  }
  if (task.has_side_by_side) {
    PrintSideBySide(task.threads.back(), MedianMs(results.front()),
                    Median(std::move(side_by_side_ms)));
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  capfit::UseLargePages();
  CLI::App app{"Median time of each stage of a fit, in milliseconds"};
  std::vector<std::string> bodies;
  std::string parts = "all";
  std::vector<int> primitives = {64};
  Task task{{}, {1, 2}, 9, false};
  app.add_option("bodies", bodies, "mesh files")->required();
  app.add_option("--primitives", primitives);
  task.options.quality = capfit::pipeline::Quality::kPaper;
  app.add_option("--quality", task.options.quality)
      ->transform(CLI::CheckedTransformer(capfit::client::QualityWords()));
  app.add_option("--fit", task.options.fit)
      ->transform(CLI::CheckedTransformer(capfit::client::FitModeWords()));
  app.add_option("--parts", parts)->check(CLI::IsMember({"all", "chains"}));
  app.add_option("--threads", task.threads);
  app.add_option("--runs", task.runs);
  app.add_flag("--side-by-side", task.has_side_by_side, "beside --threads that begin with 1");
  app.add_flag("--grow-only", task.options.grows_only);
  CLI11_PARSE(app, argc, argv);
  if (task.has_side_by_side && task.threads.front() != 1) {
    std::fprintf(stderr, "--side-by-side is held against one thread: --threads 1 2\n");
    return 2;
  }
  if (parts == "all") task.options.parts = {true, true, true, true, true, true};

  std::printf("%-42s %5s %2s", "ms", "n_p", "th");
  for (std::size_t stage = 0; stage < capfit::kStageCount; ++stage) {
    std::printf(" %8s", std::string(StageName(static_cast<capfit::Stage>(stage))).c_str());
  }
  std::printf(" %8s %8s %6s\n", "all", "E_r", "gap mm");
  bool is_well = true;
  for (const std::string& body : bodies) {
    for (const int count : primitives) {
      task.options.max_primitives = count;
      is_well = Run(body, task) && is_well;
    }
  }
  return is_well ? 0 : 2;
}
