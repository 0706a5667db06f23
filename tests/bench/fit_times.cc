// Median time of each stage of a fit, for several numbers of threads in the same run.
//
//   fit_times BODY [--primitives 64] [--quality paper|tight] [--fit enclose|best] [--threads 1 2]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "core/formats/read_mesh.h"
#include "core/pipeline/fit.h"

namespace {

using capfit::pipeline::FitOptions;
using capfit::pipeline::FitResult;

capfit::formats::PolygonSoup Read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  auto soup = capfit::formats::ReadMesh(std::as_bytes(std::span(bytes)));
  if (!soup.ok()) {
    std::fprintf(stderr, "%s\n", soup.status().ToString().c_str());
    std::exit(2);
  }
  return *std::move(soup);
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void Print(const std::string& title, const std::vector<FitResult>& results) {
  std::printf("%-10s", title.c_str());
  for (std::size_t stage = 0; stage < capfit::kStageCount; ++stage) {
    std::vector<double> ms;
    for (const FitResult& result : results) ms.push_back(1e3 * result.stage_seconds[stage]);
    std::printf(" %8.1f", Median(std::move(ms)));
  }
  std::vector<double> ms;
  for (const FitResult& result : results) ms.push_back(1e3 * result.seconds);
  std::printf(" %8.1f %8.4f %6.3f\n", Median(std::move(ms)), results[0].metrics.E_r,
              1e3 * results[0].metrics.max_gap_m);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Median time of each stage of a fit, in milliseconds"};
  std::string body;
  std::string quality = "paper";
  std::string fit = "enclose";
  std::vector<int> threads = {1, 2};
  int primitives = 64;
  int runs = 9;
  FitOptions options;
  app.add_option("body", body, "mesh file")->required();
  app.add_option("--primitives", primitives);
  app.add_option("--quality", quality)->check(CLI::IsMember({"paper", "tight"}));
  app.add_option("--fit", fit)->check(CLI::IsMember({"enclose", "best"}));
  app.add_option("--threads", threads);
  app.add_option("--runs", runs);
  app.add_flag("--grow-only", options.grows_only);
  CLI11_PARSE(app, argc, argv);
  options.max_primitives = primitives;
  options.parts = {true, true, true, true, true, true};
  if (quality == "tight") options.quality = capfit::pipeline::Quality::kTight;
  if (fit == "best") options.fit = capfit::pipeline::FitMode::kBestFit;

  const capfit::formats::PolygonSoup soup = Read(body);
  std::printf("%-10s", "threads");
  for (std::size_t stage = 0; stage < capfit::kStageCount; ++stage) {
    std::printf(" %8s", std::string(StageName(static_cast<capfit::Stage>(stage))).c_str());
  }
  std::printf(" %8s %8s %6s\n", "all", "E_r", "gap mm");
  std::vector<std::vector<FitResult>> results(threads.size());
  for (int run = 0; run <= runs; ++run) {
    for (std::size_t t = 0; t < threads.size(); ++t) {
      const capfit::ThreadPool pool(threads[t]);
      capfit::NullObserver observer;
      auto result = capfit::pipeline::Fit(soup, options, pool, observer);
      if (!result.ok()) {
        std::fprintf(stderr, "%s\n", result.status().ToString().c_str());
        return 2;
      }
      if (run > 0) results[t].push_back(*std::move(result));  // the first warms up
    }
  }
  for (std::size_t t = 0; t < threads.size(); ++t) Print(std::to_string(threads[t]), results[t]);
  return 0;
}
