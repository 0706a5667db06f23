#include "client/load_report.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace capfit::client {
namespace {

using ReportJson = nlohmann::ordered_json;

std::string TimeRow(const std::string& name, const LatencyHistogram& times) {
  if (times.count() == 0) return "";
  return absl::StrFormat("%-24s %8d %8.1f %8.1f %8.1f %8.1f %8.1f\n", name, times.count(),
                         1e3 * times.Quantile(0.5), 1e3 * times.Quantile(0.9),
                         1e3 * times.Quantile(0.99), 1e3 * times.Quantile(0.999),
                         1e3 * times.max_seconds());
}

ReportJson TimesJson(const LatencyHistogram& times) {
  return {{"calls", times.count()},
          {"mean_seconds", times.mean_seconds()},
          {"p50_seconds", times.Quantile(0.5)},
          {"p90_seconds", times.Quantile(0.9)},
          {"p99_seconds", times.Quantile(0.99)},
          {"p999_seconds", times.Quantile(0.999)},
          {"max_seconds", times.max_seconds()}};
}

double RateOf(const LoadTally& tally) {
  return static_cast<double>(tally.answered.count()) / tally.seconds;
}

std::string CodeRows(const LoadTally& tally) {
  std::string text;
  for (const auto& [code, count] : tally.codes) {
    const auto message = tally.first_message.find(code);
    absl::StrAppendFormat(&text, "%-24s %8d  %s\n", code, count,
                          message == tally.first_message.end() ? "" : message->second);
  }
  return text;
}

}  // namespace

std::string LoadTable(const LoadTally& tally, const std::vector<LoadBody>& bodies) {
  const double rate = RateOf(tally);
  std::string text = absl::StrFormat(
      "%.1f s, %.2f results a second (%.0f an hour), %.1f MB sent, %.1f MB received\n\n",
      tally.seconds, rate, 3600.0 * rate, 1e-6 * static_cast<double>(tally.bytes_sent),
      1e-6 * static_cast<double>(tally.bytes_received));
  absl::StrAppendFormat(&text, "%-24s %8s %8s %8s %8s %8s %8s\n", "milliseconds", "calls", "p50",
                        "p90", "p99", "p99.9", "most");
  absl::StrAppend(&text, TimeRow("answered", tally.answered));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    absl::StrAppend(&text, TimeRow("  " + bodies[i].name, tally.by_body[i]));
  }
  absl::StrAppend(&text, TimeRow("refused", tally.refused), "\n", CodeRows(tally));
  absl::StrAppendFormat(&text,
                        "\n%d results empty, %d not the bits of the first of their body; %d "
                        "refused without a time to come again; %d calls begun late\n",
                        tally.empty_results, tally.differing_results,
                        tally.refused_without_pushback, tally.late_calls);
  return text;
}

std::string LoadJson(const LoadTally& tally, const std::vector<LoadBody>& bodies) {
  ReportJson by_body = ReportJson::object();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    by_body[bodies[i].name] = TimesJson(tally.by_body[i]);
  }
  const ReportJson report = {{"seconds", tally.seconds},
                             {"results_per_second", RateOf(tally)},
                             {"codes", tally.codes},
                             {"first_messages", tally.first_message},
                             {"answered", TimesJson(tally.answered)},
                             {"bodies", by_body},
                             {"refused", TimesJson(tally.refused)},
                             {"bytes_sent", tally.bytes_sent},
                             {"bytes_received", tally.bytes_received},
                             {"empty_results", tally.empty_results},
                             {"differing_results", tally.differing_results},
                             {"refused_without_pushback", tally.refused_without_pushback},
                             {"late_calls", tally.late_calls}};
  return report.dump(2, ' ', false, ReportJson::error_handler_t::replace) + "\n";
}

}  // namespace capfit::client
