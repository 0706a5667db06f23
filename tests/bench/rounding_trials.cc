// How much of a figure is luck: bodies, each as it is and in copies that differ in the last digits.
// A set of many primitives is one of many nearly equal ones, and those digits choose among them. A
// change of the fit is a gain where it beats the spread printed here, not where one fit got better.
//
//   rounding_trials [BODY...] [--copies 4] [--primitives 64...] [--quality tight]
//   rounding_trials [BODY...] --max-spheres 32 --max-capsules 32
//
// Without bodies: --count mannequins by lot.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "client/option_words.h"
#include "core/pipeline/fit.h"
#include "tests/bench/read_body.h"
#include "tests/support/random_mannequin.h"

namespace capfit::bench {
namespace {

constexpr double kHundredthMm = 1e-5;
// Of a coordinate: half a micrometre on a body, about what rounding to floats does.
constexpr double kLastDigits = 2e-7;

// The first copy is the body as it is, the second is rounded to floats.
formats::PolygonSoup Copy(formats::PolygonSoup soup, int number) {
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  std::normal_distribution<double> gauss(0.0, kLastDigits);
  for (Eigen::Vector3d& position : soup.positions) {
    if (number == 1) position = position.cast<float>().cast<double>();
    if (number < 2) continue;
    for (double& coordinate : position) coordinate *= 1.0 + gauss(random);
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

// What the fits of all bodies come to.
class Spread {
 public:
  // The fits of one body's copies.
  void Add(const std::vector<pipeline::FitResult>& fits) {
    if (fits.empty()) return;
    double sum = 0.0;
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const pipeline::FitResult& fit : fits) {
      const double log = std::log(fit.metrics.E_r);
      sum += log;
      least = std::min(least, log);
      most = std::max(most, log);
      emptiest_ = std::max(emptiest_, fit.metrics.uncovered);
      seconds_ += fit.seconds;
      kept_ += Moved(fits.front().primitives, fit.primitives) < kHundredthMm ? 1 : 0;
    }
    const double mean = sum / static_cast<double>(fits.size());
    for (const pipeline::FitResult& fit : fits) {
      const double off = std::log(fit.metrics.E_r) - mean;
      squares_ += off * off;
    }
    freedom_ += static_cast<double>(fits.size() - 1);
    logs_ += sum;
    least_ += least;
    most_ += most;
    fits_ += static_cast<double>(fits.size());
    ++bodies_;
  }

  void Print(const std::string& budget) const {
    const auto mean = [](double logs, double count) { return std::exp(logs / count); };
    std::printf("%10s %6d %6.0f %8.4f %7.2f %8.4f %8.4f %8.0f %9.4f %8.1f\n", budget.c_str(),
                bodies_, fits_, mean(logs_, fits_),
                freedom_ > 0.0 ? 100.0 * std::sqrt(squares_ / freedom_) : 0.0,
                mean(least_, bodies_), mean(most_, bodies_), kept_ - bodies_, emptiest_,
                1e3 * seconds_ / fits_);
    std::fflush(stdout);
  }

  [[nodiscard]] bool IsEmpty() const { return bodies_ == 0; }

 private:
  int bodies_ = 0;
  double fits_ = 0.0;
  double logs_ = 0.0;  // of E_r
  double least_ = 0.0;
  double most_ = 0.0;
  double squares_ = 0.0;
  double freedom_ = 0.0;  // of those squares
  double kept_ = 0.0;     // fits with the spheres of their body's first
  double emptiest_ = 0.0;
  double seconds_ = 0.0;
};

Spread FitAll(const std::vector<formats::PolygonSoup>& bodies, int copies,
              const pipeline::FitOptions& options) {
  const ThreadPool pool;
  NullObserver observer;
  Spread spread;
  for (const formats::PolygonSoup& body : bodies) {
    std::vector<pipeline::FitResult> fits;
    for (int copy = 0; copy < copies; ++copy) {
      auto fit = pipeline::Fit(Copy(body, copy), options, pool, observer);
      if (fit.ok()) {
        fits.push_back(*std::move(fit));
      } else {
        std::fprintf(stderr, "copy %d: %s\n", copy, fit.status().ToString().c_str());
      }
    }
    spread.Add(fits);
  }
  return spread;
}

std::vector<formats::PolygonSoup> Bodies(const std::vector<std::string>& files, int count) {
  std::vector<formats::PolygonSoup> bodies;
  for (const std::string& file : files) {
    auto body = ReadBody(file);
    if (body.ok()) {
      bodies.push_back(*std::move(body));
    } else {
      std::fprintf(stderr, "%s\n", std::string(body.status().message()).c_str());
    }
  }
  for (int seed = 0; files.empty() && seed < count; ++seed) {
    auto body =
        mannequin::MakeMannequin(mannequin::RandomMannequin(static_cast<std::uint64_t>(seed)));
    if (body.ok()) bodies.push_back(*std::move(body));
  }
  return bodies;
}

int Main(int argc, char** argv) {
  std::vector<std::string> files;
  std::vector<int> primitives;
  int copies = 4;
  int count = 40;
  pipeline::FitOptions options;
  options.parts = {true, true, true, true, true, true};
  CLI::App app("How much of a figure is luck: fits of bodies that differ in the last digits");
  app.add_option("BODY", files, "mesh files; none: mannequins by lot");
  app.add_option("--count", count, "mannequins")->check(CLI::PositiveNumber);
  app.add_option("--copies", copies, "of each body")->check(CLI::PositiveNumber);
  auto* const sum = app.add_option("--primitives", primitives);
  app.add_option("--max-spheres", options.max_spheres)->excludes(sum);
  app.add_option("--max-capsules", options.max_capsules)->excludes(sum);
  options.quality = pipeline::Quality::kTight;
  app.add_option("--quality", options.quality)
      ->transform(CLI::CheckedTransformer(client::QualityWords()));
  app.add_option("--fit", options.fit)->transform(CLI::CheckedTransformer(client::FitModeWords()));
  CLI11_PARSE(app, argc, argv);
  if (primitives.empty() && !options.max_spheres && !options.max_capsules) primitives = {64};

  const std::vector<formats::PolygonSoup> bodies = Bodies(files, count);
  std::printf("%10s %6s %6s %8s %7s %8s %8s %8s %9s %8s\n", "primitives", "bodies", "fits", "E_r",
              "luck %", "best", "worst", "the same", "uncovered", "ms");
  bool is_well = !bodies.empty();
  const auto report = [&](const std::string& budget) {
    const Spread spread = FitAll(bodies, copies, options);
    is_well = is_well && !spread.IsEmpty();
    if (!spread.IsEmpty()) spread.Print(budget);
  };
  for (const int budget : primitives) {
    options.max_primitives = budget;
    report(std::to_string(budget));
  }
  if (primitives.empty()) report("as told");
  return is_well ? 0 : 1;
}

}  // namespace
}  // namespace capfit::bench

int main(int argc, char** argv) { return capfit::bench::Main(argc, argv); }
