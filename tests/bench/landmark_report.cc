// Landmark errors and segment accuracy on real bodies with known joints: Markdown and a plot.
//
//   landmark_report docs          writes docs/landmarks.md and docs/landmarks.svg
//   landmark_report docs --all    and prints every body in every unseen pose
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "core/mesh/prepare_mesh.h"
#include "tests/bench/landmark_samples.h"
#include "tests/core/body/body_files.h"
#include "tests/core/body/mannequin_trial.h"
#include "tests/support/bodies.h"

namespace capfit::body {
namespace {

// The columns: a joint, or both joints of a pair (the worse one is shown).
constexpr std::array<const char*, 8> kColumns = {"neck",   "shoulder", "elbow", "wrist",
                                                 "crotch", "hip",      "knee",  "ankle"};
constexpr double kMainLimitMm = 45.0;
constexpr double kShoulderHipLimitMm = 60.0;
constexpr double kLabelLimit = 0.95;
constexpr int kTrials = 300;

struct Row {
  std::string name;
  std::string pose;
  std::string failure;  // empty: found
  std::array<double, kColumns.size()> error_mm{};
  std::array<bool, kColumns.size()> is_known{};
  double labelled_right = 0.0;

  [[nodiscard]] bool IsWithinLimits() const {
    if (!failure.empty() || labelled_right < kLabelLimit) return false;
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
      if (error_mm[c] > (IsMainJoint(kColumns[c]) ? kMainLimitMm : kShoulderHipLimitMm)) {
        return false;
      }
    }
    return true;
  }
};

// What the result says of a joint, and what is so.
struct Told {
  double confidence = 0.0;
  double error_mm = 0.0;
};

struct Group {
  std::vector<Row> rows;
  std::array<std::vector<double>, kColumns.size()> errors_mm;
  std::vector<double> main_errors_mm;
  std::vector<Told> told;

  [[nodiscard]] int WithinLimits() const {
    return static_cast<int>(
        std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.IsWithinLimits(); }));
  }
};

using Report = std::map<std::string, Group>;

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

double Worst(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

std::string Rounded(double value, int digits = 0) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

void EnterErrors(const Body& body, const Sample& sample, Group& group, Row& row) {
  for (const auto& [name, truth] : sample.truth.joints) {
    if (!IsMainJoint(name) && !IsShoulderOrHip(name)) continue;
    const std::string joint = name.substr(name.find('_') + 1);
    const auto column = std::find(kColumns.begin(), kColumns.end(), joint);
    if (column == kColumns.end()) continue;
    const std::size_t at = static_cast<std::size_t>(std::distance(kColumns.begin(), column));
    const double error = ErrorMm(body, name, truth);
    row.error_mm[at] = std::max(row.error_mm[at], error);
    row.is_known[at] = true;
    group.errors_mm[at].push_back(error);
    if (IsMainJoint(name)) group.main_errors_mm.push_back(error);
    const auto& landmark = body.landmark(*LandmarkFromName(name));
    if (landmark) group.told.push_back({landmark->confidence, error});
  }
}

Report MeasureAll() {
  Report report;
  ForEachSample([&](const Sample& sample) {
    Group& group = report[sample.group];
    Row row = {sample.name, sample.pose, "", {}, {}, 0.0};
    const auto prepared = mesh::PrepareMesh(sample.truth.soup);
    const absl::StatusOr<Body> body =
        prepared.ok() ? Find(prepared->mesh) : absl::StatusOr<Body>(prepared.status());
    if (body.ok()) {
      row.labelled_right = LabelledAs(*body, sample.truth.labels);
      EnterErrors(*body, sample, group, row);
    } else {
      row.failure = std::string(body.status().message());
    }
    group.rows.push_back(row);
  });
  return report;
}

void WriteHead(const std::string& first, std::ostream& out) {
  out << "| " << first << " |";
  for (const char* const column : kColumns) out << " " << column << " |";
  out << " surface labelled right |\n|---|";
  for (std::size_t i = 0; i <= kColumns.size(); ++i) out << "---:|";
  out << "\n";
}

void WriteRow(const Row& row, std::ostream& out) {
  out << "| " << row.name << " |";
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    out << " " << (row.is_known[c] ? Rounded(row.error_mm[c]) : "") << " |";
  }
  out << " " << (row.failure.empty() ? Rounded(100.0 * row.labelled_right, 1) + " %" : row.failure)
      << " |\n";
}

void WriteTable(const Group& group, const std::string& first, std::ostream& out) {
  WriteHead(first, out);
  for (const Row& row : group.rows) WriteRow(row, out);
  for (const auto& [name, figure] :
       {std::pair("median", &Median),
        std::pair(
            "worst", +[](std::vector<double> v) { return Worst(v); })}) {
    out << "| **" << name << "** |";
    for (const auto& errors : group.errors_mm) {
      out << " " << (errors.empty() ? "" : Rounded(figure(errors))) << " |";
    }
    out << " |\n";
  }
  out << "\nWrists, elbows, knees, ankles, crotch and neck together: median "
      << Rounded(Median(group.main_errors_mm), 1) << " mm, worst "
      << Rounded(Worst(group.main_errors_mm), 1) << " mm.\n\n";
}

// One line for each pose: the worst of all bodies in it.
void WritePoses(const Group& group, std::ostream& out) {
  WriteHead("pose of 11 bodies, worst", out);
  std::vector<std::string> poses;
  for (const Row& row : group.rows) {
    if (poses.empty() || poses.back() != row.pose) poses.push_back(row.pose);
  }
  std::string beyond;  // a row of a table for each pose
  for (const std::string& pose : poses) {
    int count = 0;
    std::string names;
    Row worst = {pose, pose, "", {}, {}, 1.0};
    for (const Row& row : group.rows) {
      if (row.pose != pose) continue;
      if (!row.IsWithinLimits()) {
        ++count;
        names += (names.empty() ? "" : ", ") + row.name +
                 (row.failure.empty() ? "" : " (refused: " + row.failure + ")");
      }
      if (!row.failure.empty()) continue;
      worst.labelled_right = std::min(worst.labelled_right, row.labelled_right);
      for (std::size_t c = 0; c < kColumns.size(); ++c) {
        worst.error_mm[c] = std::max(worst.error_mm[c], row.error_mm[c]);
        worst.is_known[c] = worst.is_known[c] || row.is_known[c];
      }
    }
    if (count > 0) beyond += "| " + pose + " | " + std::to_string(count) + " | " + names + " |\n";
    WriteRow(worst, out);
  }
  out << "\nMedian of wrists, elbows, knees, ankles, crotch and neck "
      << Rounded(Median(group.main_errors_mm), 1) << " mm; " << group.WithinLimits() << " of "
      << group.rows.size() << " within all limits.";
  if (!beyond.empty()) {
    out << " Beyond one of them:\n\n| pose | of 11 bodies | which |\n|---|---:|---|\n" << beyond;
  }
  out << "\n";
}

// Ranks from 0; equals share the mean of theirs.
std::vector<double> Ranks(const std::vector<double>& values) {
  std::vector<double> ranks;
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (const double value : values) {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), value);
    ranks.push_back(0.5 * static_cast<double>((first - sorted.begin()) + (last - sorted.begin())));
  }
  return ranks;
}

// Spearman's.
double RankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = Ranks(a);
  const std::vector<double> y = Ranks(b);
  const double mean = 0.5 * static_cast<double>(x.size());
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

void WriteConfidence(const Report& report, std::ostream& out) {
  std::vector<double> confidences, errors;
  for (const char* const group : {"posed", "unseen"}) {
    for (const Told& told : report.at(group).told) {
      confidences.push_back(told.confidence);
      errors.push_back(told.error_mm);
    }
  }
  out << "## Confidence\n\nWhat the confidence of a joint says of its error, over the posed bodies "
         "and the poses made by the report.\n\n| confidence | joints | median, mm | 95 % below, mm "
         "| "
         "beyond 45 mm |\n|---|---:|---:|---:|---:|\n";
  constexpr std::array<double, 6> kBounds = {1.01, 0.75, 0.6, 0.45, 0.3, -0.01};
  for (std::size_t b = 0; b + 1 < kBounds.size(); ++b) {
    std::vector<double> within;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (confidences[i] < kBounds[b] && confidences[i] >= kBounds[b + 1]) {
        within.push_back(errors[i]);
      }
    }
    if (within.empty()) continue;
    std::sort(within.begin(), within.end());
    const auto beyond = within.end() - std::upper_bound(within.begin(), within.end(), kMainLimitMm);
    out << "| " << Rounded(std::max(0.0, kBounds[b + 1]), 2) << " to "
        << Rounded(std::min(1.0, kBounds[b]), 2) << " | " << within.size() << " | "
        << Rounded(within[within.size() / 2], 1) << " | "
        << Rounded(within[within.size() * 19 / 20]) << " | "
        << Rounded(100.0 * static_cast<double>(beyond) / within.size(), 1) << " % |\n";
  }
  out << "\nRank correlation of confidence and error: "
      << Rounded(RankCorrelation(confidences, errors), 2) << " (-1 would be perfect).\n\n";
}

int GoodTrials() {
  int good = 0;
  for (int seed = 0; seed < kTrials; ++seed) {
    const MannequinTrial trial = MakeMannequinTrial(static_cast<std::uint64_t>(seed));
    const auto prepared = mesh::PrepareMesh(trial.battered);
    if (!prepared.ok()) continue;
    const auto body = Find(prepared->mesh);
    good += body.ok() && FaultsOf(*body, trial).empty() ? 1 : 0;
  }
  return good;
}

void WriteMarkdown(const Report& report, std::ostream& out) {
  out << "# How near the landmarks come\n\n"
         "Millimetres from the joints of the skeletons that real bodies were made with, the worse "
         "of left and\nright, and the share of the surface whose part is the right one. The joints "
         "lie where an animator puts\nthem; one to three centimetres of honest disagreement are to "
         "be expected. Limits: 45 mm, for shoulders\nand hips 60 mm; 95 % of the surface. Made by "
         "`landmark_report docs` (tests/bench).\n\n"
         "![Errors by joint](landmarks.svg)\n\n## Bodies and poses\n\n";
  WriteTable(report.at("posed"), "body and pose", out);
  out << "## Number of faces\n\nThe average woman at rest with other numbers of faces; `remeshed` "
         "is a new surface from a voxel grid.\n\n";
  WriteTable(report.at("density"), "mesh", out);
  out << "## Walking, then raising the arms\n\nEvery sixth frame of an animation of 10,000 "
         "triangles.\n\n";
  WriteTable(report.at("animation"), "frame", out);
  out << "## Poses made by the report\n\nThe eleven bodies at rest, posed by the report "
         "itself (plain skinning, so skin folds more than it should).\n\n";
  WritePoses(report.at("unseen"), out);
  WriteConfidence(report, out);
  out << "## Mannequins by lot\n\n"
      << kTrials
      << " random mannequins (measures, pose, density, head, hands and feet there or not), turned "
         "anyhow,\nhalf of them mirrored, two in three with noise of 2 mm, two in three with 5 % "
         "of the faces dropped:\n"
      << GoodTrials() << " are found with every landmark in its part.\n";
}

// One column of dots for each joint, with its median and the limit.
void WritePlot(const Group& group, std::ostream& out) {
  constexpr double kLeft = 60, kTop = 20, kColumnWidth = 90, kHeight = 320, kMaxMm = 70;
  const double width = kLeft + kColumnWidth * kColumns.size() + 20;
  const auto y = [&](double mm) { return kTop + kHeight * (1.0 - std::min(mm, kMaxMm) / kMaxMm); };
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
    const std::vector<double>& errors = group.errors_mm[c];
    const double limit = IsMainJoint(kColumns[c]) ? kMainLimitMm : kShoulderHipLimitMm;
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
  const bool wants_all = argc == 3 && std::string(argv[2]) == "--all";
  if ((argc != 2 && !wants_all) || test_support::BodiesFolder().empty()) {
    std::fprintf(stderr,
                 "usage: landmark_report FOLDER [--all]; needs the real bodies ($CAPFIT_BODIES)\n");
    return 1;
  }
  const std::string folder = argv[1];
  const Report report = MeasureAll();
  if (wants_all) {
    for (Row row : report.at("unseen").rows) {
      row.name = row.pose + " " + row.name;
      WriteRow(row, std::cout);
    }
  }
  std::ofstream markdown(folder + "/landmarks.md");
  WriteMarkdown(report, markdown);
  std::ofstream plot(folder + "/landmarks.svg");
  WritePlot(report.at("posed"), plot);
  return markdown.good() && plot.good() ? 0 : 1;
}

}  // namespace
}  // namespace capfit::body

int main(int argc, char** argv) { return capfit::body::Main(argc, argv); }
