// What keeping a layout costs: each body fitted freely (32 spheres, 32 capsules, tight, all parts)
// and to the layout of another body's result.
//
//   layout_report BODY... [--from NAME|BODY]... E_r and time of each, and their ratios
//   layout_report BODY... --neighbour           each to the layout of its own free result
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "core/pipeline/fit.h"
#include "core/refine/layouts/standard_layouts.h"
#include "tests/bench/read_body.h"

namespace {

using capfit::formats::PolygonSoup;
using capfit::pipeline::FitOptions;
using capfit::pipeline::FitResult;
using capfit::refine::KeptLayout;
using Clock = std::chrono::steady_clock;

struct Timed {
  FitResult result;
  double ms = 0.0;
};

std::optional<PolygonSoup> Read(const std::string& path) {
  auto soup = capfit::bench::ReadBody(path);
  if (!soup.ok()) {
    std::fprintf(stderr, "%s\n", soup.status().ToString().c_str());
    return std::nullopt;
  }
  return *std::move(soup);
}

std::optional<Timed> FitOnce(const PolygonSoup& soup, const FitOptions& options) {
  const capfit::ThreadPool pool(0);
  capfit::NullObserver observer;
  const auto begin = Clock::now();
  auto result = capfit::pipeline::Fit(soup, options, pool, observer);
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  if (!result.ok()) {
    std::fprintf(stderr, "%s\n", result.status().ToString().c_str());
    return std::nullopt;
  }
  return Timed{*std::move(result), ms};
}

// The one of the fastest of a few runs, whose results are the same.
std::optional<Timed> FitTimed(const PolygonSoup& soup, const FitOptions& options, int runs) {
  std::optional<Timed> best;
  for (int i = 0; i < runs; ++i) {
    std::optional<Timed> next = FitOnce(soup, options);
    if (!next) return std::nullopt;
    if (!best || next->ms < best->ms) best = std::move(next);
  }
  return best;
}

FitOptions Free(int spheres, bool best_fit) {
  FitOptions options;
  options.quality = capfit::pipeline::Quality::kTight;
  options.fit =
      best_fit ? capfit::pipeline::FitMode::kBestFit : capfit::pipeline::FitMode::kEnclose;
  options.parts = {true, true, true, true, true, true};
  options.max_spheres = spheres;
  options.max_capsules = spheres;
  return options;
}

FitOptions Keeping(const KeptLayout& layout, bool best_fit) {
  FitOptions options = Free(0, best_fit);
  options.max_spheres = options.max_capsules = std::nullopt;
  options.layout = layout;
  return options;
}

void PrintStages(const char* what, const FitResult& result) {
  std::fprintf(stderr, "%s:", what);
  for (const double seconds : result.stage_seconds) std::fprintf(stderr, " %.1f", 1e3 * seconds);
  std::fprintf(stderr, " ms\n");
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What keeping a layout costs");
  std::vector<std::string> bodies;
  std::vector<std::string> from;
  bool neighbour = false;
  bool best_fit = false;
  bool stages = false;
  int spheres = 32;
  int runs = 1;
  app.add_option("BODY", bodies)->required();
  app.add_option("--from", from, "Standard layouts, or bodies whose free results give them");
  app.add_flag("--neighbour", neighbour, "Each body keeps the layout of its own free result");
  app.add_flag("--stages", stages, "Milliseconds of each stage too, to standard error");
  app.add_flag("--best", best_fit, "Best fits");
  app.add_option("--spheres", spheres, "Spheres, and as many capsules");
  app.add_option("--runs", runs, "Times are those of the fastest");
  CLI11_PARSE(app, argc, argv);

  std::vector<KeptLayout> layouts;
  for (const std::string& path : from) {
    if (const KeptLayout* standard = capfit::refine::FindStandardLayout(path)) {
      layouts.push_back(*standard);
      continue;
    }
    const auto soup = Read(path);
    const auto fit = soup ? FitOnce(*soup, Free(spheres, best_fit)) : std::nullopt;
    if (!fit) return 1;
    layouts.push_back(LayoutOf(fit->result));
    layouts.back().name = std::filesystem::path(path).stem().string();
  }
  std::printf("%-34s %7s %7s", "body", "E_r", "ms");
  for (const KeptLayout& layout : layouts) std::printf("  %-22.22s", layout.name.c_str());
  std::printf("\n");
  std::vector<std::vector<double>> ratios(layouts.size() + 1);
  std::vector<std::vector<double>> times(layouts.size() + 1);
  for (const std::string& path : bodies) {
    const auto soup = Read(path);
    const auto free = soup ? FitTimed(*soup, Free(spheres, best_fit), runs) : std::nullopt;
    if (!free) continue;
    std::printf("%-34s %7.4f %7.1f", std::filesystem::path(path).stem().c_str(),
                free->result.metrics.E_r, free->ms);
    std::vector<KeptLayout> kept = layouts;
    if (neighbour) kept.push_back(LayoutOf(free->result));
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const auto fit = FitTimed(*soup, Keeping(kept[i], best_fit), runs);
      if (!fit) continue;
      if (stages) {
        PrintStages("free", free->result);
        PrintStages("kept", fit->result);
      }
      const double ratio = fit->result.metrics.E_r / free->result.metrics.E_r;
      ratios[i].push_back(ratio);
      times[i].push_back(fit->ms / free->ms);
      std::printf("  %.4f (%.3f) %.2f t", fit->result.metrics.E_r, ratio, fit->ms / free->ms);
      if (fit->result.metrics.vertices_out > 0) {
        std::printf(" %d OUT", fit->result.metrics.vertices_out);
      }
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  std::printf("%-34s %7s %7s", "median ratio", "", "");
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    if (!ratios[i].empty())
      std::printf("         (%.3f) %.2f t", Median(ratios[i]), Median(times[i]));
  }
  std::printf("\n");
  return 0;
}
