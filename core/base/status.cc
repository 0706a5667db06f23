#include "core/base/status.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "absl/strings/cord.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "core/base/enum_index.h"

namespace capfit {
namespace {

constexpr char kFieldUrl[] = "capfit.v1/field";
constexpr char kReasonUrl[] = "capfit.v1/reason";
constexpr char kFactsUrl[] = "capfit.v1/facts";
constexpr char kWarningsUrl[] = "capfit.v1/warnings";

// Payloads of several texts: lines of cells, so the texts themselves must have neither separator.
constexpr char kCell = '\t';
constexpr char kLine = '\n';

std::string OneCell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == kCell || c == kLine; }, ' ');
  return text;
}

std::optional<std::string> PayloadOf(const absl::Status& status, const char* url) {
  const absl::optional<absl::Cord> payload = status.GetPayload(url);
  if (!payload.has_value()) return std::nullopt;
  return std::string(*payload);
}

// The lines of a payload that have `cells` cells each.
std::vector<std::vector<std::string>> RowsOf(const absl::Status& status, const char* url,
                                             std::size_t cells) {
  std::vector<std::vector<std::string>> rows;
  const std::string text = PayloadOf(status, url).value_or("");
  for (const auto line : absl::StrSplit(text, kLine, absl::SkipEmpty())) {
    std::vector<std::string> row = absl::StrSplit(line, kCell);
    if (row.size() == cells) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

absl::Status OutOfRange(const std::string& field, double value, double low, double high) {
  const std::string range = absl::StrCat("[", low, ", ", high, "]");
  std::string text = absl::StrCat(value);
  for (int digits = 7; digits <= 17 && (text == absl::StrCat(low) || text == absl::StrCat(high));
       ++digits) {
    text = absl::StrFormat("%.*g", digits, value);
  }
  return InvalidField(std::isfinite(value) ? ErrorReason::kOutOfRange : ErrorReason::kNotFinite,
                      field, absl::StrCat("is ", text, ", must be in ", range),
                      {{"value", text}, {"limit", range}});
}

absl::Status Refused(ErrorReason reason, const std::string& message, const ErrorFacts& facts) {
  const KnownReason& known = ErrorReasons()[Index(reason)];
  absl::Status status(known.code, message);
  status.SetPayload(kReasonUrl, absl::Cord(std::string(known.name)));
  std::string text;
  for (const auto& [name, value] : facts) {
    absl::StrAppend(&text, OneCell(name), std::string(1, kCell), OneCell(value),
                    std::string(1, kLine));
  }
  if (!text.empty()) status.SetPayload(kFactsUrl, absl::Cord(text));
  return status;
}

absl::Status InvalidField(ErrorReason reason, const std::string& field, const std::string& problem,
                          const ErrorFacts& facts) {
  absl::Status status = Refused(reason, absl::StrCat(field, " ", problem), facts);
  status.SetPayload(kFieldUrl, absl::Cord(field));
  return status;
}

absl::Status WithField(const absl::Status& status, const std::string& field) {
  const std::optional<std::string> before = FieldOf(status);
  if (!before) return status;
  const std::string message(status.message());
  absl::Status renamed(status.code(), absl::StrCat(field, message.substr(before->size())));
  status.ForEachPayload(
      [&](absl::string_view url, const absl::Cord& payload) { renamed.SetPayload(url, payload); });
  renamed.SetPayload(kFieldUrl, absl::Cord(field));
  return renamed;
}

std::optional<std::string> FieldOf(const absl::Status& status) {
  return PayloadOf(status, kFieldUrl);
}

std::optional<ErrorReason> ReasonOf(const absl::Status& status) {
  const std::optional<std::string> name = PayloadOf(status, kReasonUrl);
  return name ? ErrorReasonFromName(*name) : std::nullopt;
}

ErrorFacts FactsOf(const absl::Status& status) {
  ErrorFacts facts;
  for (std::vector<std::string>& row : RowsOf(status, kFactsUrl, 2)) {
    facts.emplace_back(std::move(row[0]), std::move(row[1]));
  }
  return facts;
}

absl::Status WithWarnings(absl::Status status, std::span<const Warning> warnings) {
  if (status.ok() || warnings.empty()) return status;
  std::string text;
  for (const Warning& warning : warnings) {
    absl::StrAppend(&text, OneCell(warning.code), std::string(1, kCell), warning.count,
                    std::string(1, kCell), OneCell(warning.message), std::string(1, kLine));
  }
  status.SetPayload(kWarningsUrl, absl::Cord(text));
  return status;
}

std::vector<Warning> WarningsOf(const absl::Status& status) {
  std::vector<Warning> warnings;
  for (std::vector<std::string>& row : RowsOf(status, kWarningsUrl, 3)) {
    warnings.push_back({std::move(row[0]), std::move(row[2]), std::atoll(row[1].c_str())});
  }
  return warnings;
}

}  // namespace capfit
