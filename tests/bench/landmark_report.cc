// Landmark errors and segment accuracy on the real bodies, as a Markdown table and an SVG plot.
//
//   landmark_report > docs/landmarks.md --plot docs/landmarks.svg
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "tests/core/body/body_files.h"
#include "tests/support/bodies.h"

namespace capfit::body {
namespace {

// The columns: a joint, or both joints of a pair (the worse one is shown).
constexpr std::array<const char*, 8> kColumns = {"neck",   "shoulder", "elbow", "wrist",
                                                 "crotch", "hip",      "knee",  "ankle"};

struct Row {
  std::string name;
  std::array<double, kColumns.size()> error_mm{};
  double labelled_right = 0.0;
};

struct Report {
  std::vector<Row> rows;
  std::array<std::vector<double>, kColumns.size()> errors_mm;
  std::vector<double> main_errors_mm;
};

Report Measure() {
  Report report;
  for (const PosedBody& posed : PosedBodies()) {
    const absl::StatusOr<Body> body = Find(LoadBody(posed.file));
    if (!body.ok()) {
      std::fprintf(stderr, "%s: %s\n", posed.file.c_str(), body.status().ToString().c_str());
      continue;
    }
    Row row = {posed.file.substr(0, posed.file.size() - 4), {}, LabelledRight(*body, "labels.bin")};
    for (const auto& [name, truth] : posed.points) {
      if (!IsMainJoint(name) && !IsShoulderOrHip(name)) continue;
      const double error = ErrorMm(*body, name, truth);
      const std::string joint = name.substr(name.find('_') + 1);
      const auto column = std::find(kColumns.begin(), kColumns.end(), joint);
      if (column == kColumns.end()) continue;
      const std::size_t at = static_cast<std::size_t>(std::distance(kColumns.begin(), column));
      row.error_mm[at] = std::max(row.error_mm[at], error);
      report.errors_mm[at].push_back(error);
      if (IsMainJoint(name)) report.main_errors_mm.push_back(error);
    }
    report.rows.push_back(row);
  }
  return report;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

double Worst(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

void PrintTable(const Report& report) {
  std::printf("| body and pose |");
  for (const char* const column : kColumns) std::printf(" %s |", column);
  std::printf(" surface labelled right |\n|---|");
  for (std::size_t i = 0; i <= kColumns.size(); ++i) std::printf("---:|");
  std::printf("\n");
  for (const Row& row : report.rows) {
    std::printf("| %s |", row.name.c_str());
    for (const double error : row.error_mm) std::printf(" %.0f |", error);
    std::printf(" %.1f %% |\n", 100.0 * row.labelled_right);
  }
  std::printf("| **median** |");
  for (const auto& errors : report.errors_mm) std::printf(" %.0f |", Median(errors));
  std::printf(" |\n| **worst** |");
  for (const auto& errors : report.errors_mm) std::printf(" %.0f |", Worst(errors));
  std::printf(" |\n\nMillimetres to the joints of the skeleton, the worse of left and right. ");
  std::printf("Wrists, elbows, knees, ankles, crotch and neck together: median %.1f, worst %.1f.\n",
              Median(report.main_errors_mm), Worst(report.main_errors_mm));
}

// One column of dots for each joint, with its median and the limit.
void WritePlot(const Report& report, const std::string& path) {
  constexpr double kLeft = 60, kTop = 20, kColumnWidth = 90, kHeight = 320, kMaxMm = 70;
  const double width = kLeft + kColumnWidth * kColumns.size() + 20;
  const auto y = [&](double mm) { return kTop + kHeight * (1.0 - std::min(mm, kMaxMm) / kMaxMm); };
  std::ofstream out(path);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << " 390\" "
      << "font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  for (int mm = 0; mm <= kMaxMm; mm += 10) {
    out << "<line x1=\"" << kLeft << "\" x2=\"" << width - 20 << "\" y1=\"" << y(mm) << "\" y2=\""
        << y(mm) << "\" stroke=\"#ddd\"/><text x=\"" << kLeft - 8 << "\" y=\"" << y(mm) + 4
        << "\" text-anchor=\"end\">" << mm << "</text>\n";
  }
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    const double x = kLeft + kColumnWidth * (static_cast<double>(c) + 0.5);
    const std::vector<double>& errors = report.errors_mm[c];
    const double limit = IsMainJoint(kColumns[c]) ? 45.0 : 60.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double spread =
          40.0 * (static_cast<double>(i) / static_cast<double>(errors.size()) - 0.5);
      out << "<circle cx=\"" << x + spread << "\" cy=\"" << y(errors[i])
          << "\" r=\"3\" fill=\"#2f6fb0\" fill-opacity=\"0.55\"/>\n";
    }
    out << "<line x1=\"" << x - 30 << "\" x2=\"" << x + 30 << "\" y1=\"" << y(Median(errors))
        << "\" y2=\"" << y(Median(errors)) << "\" stroke=\"black\" stroke-width=\"2\"/>\n"
        << "<line x1=\"" << x - 30 << "\" x2=\"" << x + 30 << "\" y1=\"" << y(limit) << "\" y2=\""
        << y(limit) << "\" stroke=\"#c0392b\" stroke-dasharray=\"4 3\"/>\n"
        << "<text x=\"" << x << "\" y=\"360\" text-anchor=\"middle\">" << kColumns[c]
        << "</text>\n";
  }
  out << "<text x=\"" << kLeft << "\" y=\"382\" fill=\"#555\">millimetres to the joint; black: "
      << "median; red: limit; one dot for each joint of each body and pose</text>\n</svg>\n";
}

int Main(int argc, char** argv) {
  if (test_support::BodiesFolder().empty()) {
    std::fprintf(stderr, "no real bodies found; set CAPFIT_BODIES to their folder\n");
    return 1;
  }
  const Report report = Measure();
  PrintTable(report);
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string(argv[i]) == "--plot") WritePlot(report, argv[i + 1]);
  }
  return 0;
}

}  // namespace
}  // namespace capfit::body

int main(int argc, char** argv) { return capfit::body::Main(argc, argv); }
