// All that a refusal tells, as one line to compare.
#ifndef CAPFIT_TESTS_SUPPORT_TOLD_H_
#define CAPFIT_TESTS_SUPPORT_TOLD_H_

#include <gtest/gtest.h>

#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit {

// "REASON [line=5, value=4, limit=[1, 3]] message"; "accepted" for OK. Where there is a field, the
// message must begin with it.
[[nodiscard]] inline std::string Told(const absl::Status& status) {
  if (status.ok()) return "accepted";
  const std::string message(status.message());
  if (const auto field = FieldOf(status)) {
    EXPECT_EQ(message.substr(0, field->size() + 1), *field + " ") << status;
  }
  const auto reason = ReasonOf(status);
  std::string facts;
  for (const auto& [name, value] : FactsOf(status)) {
    absl::StrAppend(&facts, facts.empty() ? "" : ", ", name, "=", value);
  }
  const std::string word = reason ? std::string(ErrorReasonName(*reason)) : "NO REASON";
  return absl::StrCat(word, facts.empty() ? "" : " [" + facts + "]", " ", message);
}

}  // namespace capfit

#endif  // CAPFIT_TESTS_SUPPORT_TOLD_H_
