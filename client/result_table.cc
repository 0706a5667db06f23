#include "client/result_table.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/body/anatomy.h"

namespace capfit::client {
namespace {

template <typename... Values>
std::string Line(const char* format, Values... values) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return std::string(text.data()) + "\n";
}

struct Count {
  int spheres = 0;
  int capsules = 0;
};

// A capsule counts for its ends' part; one between two parts for the outer one, which is the later
// in the list of parts.
std::array<Count, body::kPartCount> CountByPart(const capsule::PrimitiveSet& set) {
  std::array<Count, body::kPartCount> counts{};
  const auto part_of = [&](int sphere) {
    return static_cast<std::size_t>(set.origins[static_cast<std::size_t>(sphere)].part);
  };
  for (std::size_t i = 0; i < set.origins.size(); ++i) {
    ++counts[part_of(static_cast<int>(i))].spheres;
  }
  for (const capsule::CapsuleEnds& ends : set.capsules) {
    ++counts[std::max(part_of(ends[0]), part_of(ends[1]))].capsules;
  }
  return counts;
}

std::string PartsTable(const capsule::PrimitiveSet& set) {
  const auto counts = CountByPart(set);
  std::string table = Line("%-12s %8s %9s", "part", "spheres", "capsules");
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].spheres == 0) continue;
    const std::string name(body::PartName(static_cast<body::Part>(i)));
    table += Line("%-12s %8d %9d", name.c_str(), counts[i].spheres, counts[i].capsules);
  }
  return table + Line("%-12s %8zu %9zu", "total", set.spheres.size(), set.capsules.size());
}

std::string StagesTable(const pipeline::FitResult& result) {
  std::string table = Line("%-12s %10s", "stage", "time");
  for (std::size_t i = 0; i < result.stage_seconds.size(); ++i) {
    if (result.stage_seconds[i] <= 0.0) continue;
    const std::string name(StageName(static_cast<Stage>(i)));
    table += Line("%-12s %7.1f ms", name.c_str(), 1000.0 * result.stage_seconds[i]);
  }
  return table + Line("%-12s %7.1f ms", "total", 1000.0 * result.seconds);
}

}  // namespace

std::string MetricsTable(const metrics::Metrics& metrics) {
  return Line("%-12s %10d     spheres + cones", "n_p", metrics.n_p) +
         Line("%-12s %10.4f     outside %.4f + uncovered %.4f of the fitted parts' volume", "E_r",
              metrics.E_r, metrics.outside, metrics.uncovered) +
         Line("%-12s %10.3f %%   of the fitted parts' box diagonal, worst %.2f %%", "E_M",
              metrics.E_M, metrics.hausdorff) +
         Line("%-12s %10d     vertices outside, worst %.2f mm", "coverage", metrics.vertices_out,
              1000.0 * metrics.max_out_m) +
         Line("%-12s %10.3f mm  no point of the surface is further out", "max gap",
              1000.0 * metrics.max_gap_m);
}

std::string ResultTable(const pipeline::FitResult& result) {
  std::string table = PartsTable(result.primitives) + "\n" + MetricsTable(result.metrics) + "\n" +
                      StagesTable(result);
  if (!result.warnings.empty()) table += "\n";
  for (const Warning& warning : result.warnings) {
    table += "warning: " + warning.message + " (" + warning.code + ")\n";
  }
  return table;
}

}  // namespace capfit::client
