// How far a fit moves with the last digits of its input: mannequins by lot, each as it is and with
// its vertices rounded to floats.
//
//   rounding_trials [--count 160] [--primitives 64] [--quality paper]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

#include "core/pipeline/fit.h"
#include "tests/support/random_mannequin.h"

namespace capfit {
namespace {

constexpr double kHundredthMm = 1e-5;
constexpr double kTenthMm = 1e-4;

formats::PolygonSoup Rounded(formats::PolygonSoup soup) {
  for (Eigen::Vector3d& position : soup.positions) {
    position = position.cast<float>().cast<double>();
  }
  return soup;
}

// The farthest that a centre or a radius moved; infinite where there are other spheres.
double Moved(const capsule::PrimitiveSet& a, const capsule::PrimitiveSet& b) {
  if (a.spheres.size() != b.spheres.size()) return std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.spheres.size(); ++i) {
    farthest = std::max({farthest, (a.spheres[i].center_m - b.spheres[i].center_m).norm(),
                         std::abs(a.spheres[i].radius_m - b.spheres[i].radius_m)});
  }
  return farthest;
}

int Main(int argc, char** argv) {
  int count = 160;
  pipeline::FitOptions options;
  options.max_primitives = 64;
  options.parts = {true, true, true, true, true, true};
  std::string quality = "paper";
  CLI::App app("How far a fit moves with the last digits of its input");
  app.add_option("--count", count, "mannequins")->check(CLI::PositiveNumber);
  app.add_option("--primitives", options.max_primitives);
  app.add_option("--quality", quality)->check(CLI::IsMember({"paper", "balanced", "tight"}));
  CLI11_PARSE(app, argc, argv);
  for (int q = 0; q < pipeline::kQualityCount; ++q) {
    const auto named = static_cast<pipeline::Quality>(q);
    if (pipeline::QualityName(named) == quality) options.quality = named;
  }
  const ThreadPool pool;
  NullObserver nobody;
  int fitted = 0;
  int within_hundredth = 0;
  int within_tenth = 0;
  double log_ratios = 0.0;
  double logs = 0.0;
  for (int seed = 0; seed < count; ++seed) {
    const auto body =
        mannequin::MakeMannequin(mannequin::RandomMannequin(static_cast<std::uint64_t>(seed)));
    if (!body.ok()) continue;
    const auto fit = pipeline::Fit(*body, options, pool, nobody);
    const auto other = pipeline::Fit(Rounded(*body), options, pool, nobody);
    if (!fit.ok() || !other.ok()) continue;
    ++fitted;
    const double moved = Moved(fit->primitives, other->primitives);
    within_hundredth += moved < kHundredthMm ? 1 : 0;
    within_tenth += moved < kTenthMm ? 1 : 0;
    log_ratios += std::abs(std::log(fit->metrics.E_r / other->metrics.E_r));
    logs += std::log(fit->metrics.E_r);
  }
  std::printf(
      "%d bodies: %d keep their spheres to .01 mm, %d to .1 mm; E_r moves by %.3f %%; its "
      "geometric "
      "mean is %.4f\n",
      fitted, within_hundredth, within_tenth, 100.0 * log_ratios / fitted, std::exp(logs / fitted));
  return fitted > 0 ? 0 : 1;
}

}  // namespace
}  // namespace capfit

int main(int argc, char** argv) { return capfit::Main(argc, argv); }
