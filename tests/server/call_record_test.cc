#include "server/call_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/status.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;
using testing::Not;

CallRecord Hostile() {
  CallRecord record;
  record.method = "ApproximateBody";
  record.request_id = "a\" status=OK\n\x1b[31m \xff\\";
  record.peer = "ipv4:192.0.2.7:4711";
  record.client = "192.0.2.7";
  record.options = "tight enclose";
  record.trace = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";
  record.received_bytes = 123;
  record.queued_seconds = 0.25;
  record.fit_seconds = 1.5;
  record.status = Refused(ErrorReason::kCancelled, "the caller gave up");
  return record;
}

TEST(CallLine, TextKeepsWhatCallersSayInsideOfQuotes) {
  const std::string line = CallLine(Hostile(), LogFormat::kText);
  EXPECT_THAT(line, HasSubstr(R"(ApproximateBody id="a\" status=OK\n\u001b[31m \ufffd\\" )"));
  EXPECT_THAT(line, HasSubstr(" bytes=123 "));
  EXPECT_THAT(line, HasSubstr(" queued_seconds=0.25 fit_seconds=1.5 "));
  EXPECT_THAT(line, HasSubstr(" options=\"tight enclose\" priority=interactive "));
  EXPECT_THAT(line, HasSubstr(" status=CANCELLED reason=CANCELLED message=\"the caller gave up\""));
  for (const char c : line) EXPECT_TRUE(c >= 32 && c < 127) << static_cast<int>(c);
}

TEST(CallLine, JsonIsOneObjectOfTheSameKeys) {
  const std::string line = CallLine(Hostile(), LogFormat::kJson);
  EXPECT_THAT(line, Not(HasSubstr("\n")));
  const nlohmann::json object = nlohmann::json::parse(line);
  EXPECT_EQ(object["method"], "ApproximateBody");
  EXPECT_EQ(object["id"], "a\" status=OK\n\x1b[31m \xef\xbf\xbd\\");
  EXPECT_EQ(object["traceparent"], Hostile().trace);
  EXPECT_EQ(object["status"], "CANCELLED");
  EXPECT_EQ(object["fit_seconds"], 1.5);
}

TEST(WastedSeconds, AreThoseOfFitsWhoseResultNobodyGot) {
  CallRecord record = Hostile();
  EXPECT_EQ(WastedSeconds(record), 1.5);
  record.status = Refused(ErrorReason::kFitTooLong, "");
  EXPECT_EQ(WastedSeconds(record), 1.5);
  record.status = absl::OkStatus();
  EXPECT_EQ(WastedSeconds(record), 0.0);
  record.status = Refused(ErrorReason::kNotABody, "");
  EXPECT_EQ(WastedSeconds(record), 0.0) << "an answer, though not the one hoped for";
}

}  // namespace
}  // namespace capfit::server
