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

template <typename AnyMetrics>
std::string PartLine(const std::string& name, const AnyMetrics& m, double volume_m3) {
  return Line("%-10s %7d %8d %7.3f %6.4f %7.4f %7.4f %6.3f %6.2f %6.2f %6.2f %6.2f %5d",
              name.c_str(), m.spheres, m.capsules, 1000.0 * volume_m3, m.E_r, m.outside,
              m.uncovered, m.volume_ratio, 1000.0 * m.gap.mean_m, 1000.0 * m.gap.p95_m,
              1000.0 * m.gap.max_m, 100.0 * m.surface_out, m.vertices_out);
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
  return Line("%-12s %10d     %d spheres + %d capsules", "n_p", metrics.n_p, metrics.spheres,
              metrics.capsules) +
         Line("%-12s %10.4f     outside %.4f + uncovered %.4f of the fitted parts' volume", "E_r",
              metrics.E_r, metrics.outside, metrics.uncovered) +
         Line("%-12s %10.4f     primitives / fitted parts; common / joint volume %.4f",
              "volume ratio", metrics.volume_ratio, metrics.iou) +
         Line("%-12s %10.3f %%   of the fitted parts' box diagonal, worst %.2f %%", "E_M",
              metrics.E_M, metrics.hausdorff) +
         Line("%-12s %10.2f mm  mean from skin to primitives, 95 %% within %.2f mm, worst %.2f mm",
              "gap", 1000.0 * metrics.gap.mean_m, 1000.0 * metrics.gap.p95_m,
              1000.0 * metrics.gap.max_m) +
         Line("%-12s %10d     vertices outside, worst %.2f mm; %.2f %% of the skin", "coverage",
              metrics.vertices_out, 1000.0 * metrics.max_out_m, 100.0 * metrics.surface_out) +
         Line("%-12s %10.3f mm  no point of the surface is further out", "max gap",
              1000.0 * metrics.max_gap_m) +
         Line("%-12s %10.2e     volume of (primitives xor their mirror image) / primitives",
              "mirror error", metrics.mirror_error);
}

std::string PartsTable(const metrics::Metrics& metrics) {
  constexpr char kNames[] = "%-10s %7s %8s %7s %6s %7s %7s %6s %6s %6s %6s %6s %5s";
  std::string table = Line(kNames, "part", "spheres", "capsules", "volume", "E_r", "outside", "un-",
                           "volume", "gap mm", "gap mm", "gap mm", "skin", "vert.") +
                      Line(kNames, "", "", "", "litres", "", "", "covered", "ratio", "mean", "95 %",
                           "max", "out %", "out");
  double volume_m3 = 0.0;
  for (std::size_t p = 0; p < metrics.parts.size(); ++p) {
    if (!metrics.parts[p]) continue;
    const std::string name(body::PartName(static_cast<body::Part>(p)));
    table += PartLine(name, *metrics.parts[p], metrics.parts[p]->volume_m3);
    volume_m3 += metrics.parts[p]->volume_m3;
  }
  return table + PartLine("total", metrics, volume_m3);
}

std::string ResultTable(const pipeline::FitResult& result) {
  return PartsTable(result.metrics) + "\n" + MetricsTable(result.metrics) + "\n" +
         StagesTable(result);
}

}  // namespace capfit::client
