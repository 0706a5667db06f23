#include "proto/wire/status_conversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "capfit/v1/error.pb.h"
#include "core/base/status.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace capfit::wire {
namespace {

template <typename Detail>
std::optional<Detail> Find(const grpc::Status& status) {
  google::rpc::Status rich;
  if (!rich.ParseFromString(status.error_details())) return std::nullopt;
  for (const auto& any : rich.details()) {
    Detail detail;
    if (any.UnpackTo(&detail)) return detail;
  }
  return std::nullopt;
}

TEST(StatusConversion, OkHasNoDetails) {
  EXPECT_TRUE(ToGrpcStatus(absl::OkStatus()).ok());
  EXPECT_TRUE(FromGrpcStatus(grpc::Status::OK).ok());
}

TEST(StatusConversion, AWrongFieldBecomesABadRequest) {
  const grpc::Status status = ToGrpcStatus(InvalidField(
      ErrorReason::kOutOfRange, "triangle_indices[17]", "is 90210, must be below 6890"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(), "triangle_indices[17] is 90210, must be below 6890");
  const auto bad_request = Find<google::rpc::BadRequest>(status);
  ASSERT_TRUE(bad_request);
  ASSERT_EQ(bad_request->field_violations_size(), 1);
  EXPECT_EQ(bad_request->field_violations(0).field(), "triangle_indices[17]");
  EXPECT_EQ(bad_request->field_violations(0).description(), status.error_message());
  EXPECT_EQ(Find<google::rpc::ErrorInfo>(status)->domain(), "capfit");
}

TEST(StatusConversion, AReasonBecomesErrorInfo) {
  const grpc::Status status =
      ToGrpcStatus(Refused(ErrorReason::kNotABody, "found 0 of 5 extremities"));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(Find<google::rpc::ErrorInfo>(status)->reason(), "NOT_A_BODY");
  EXPECT_FALSE(Find<google::rpc::BadRequest>(status));
}

TEST(StatusConversion, CodeMessageFieldAndReasonComeBack) {
  for (const absl::Status& status :
       {InvalidField(ErrorReason::kOutOfRange, "a[1].b", "is 3, limit 2"),
        Refused(ErrorReason::kPartMissing, "no left arm"), absl::UnimplementedError("later"),
        absl::ResourceExhaustedError("full"), absl::CancelledError("gone"),
        absl::InternalError("bug"), absl::InvalidArgumentError("plain")}) {
    const absl::Status back = FromGrpcStatus(ToGrpcStatus(status));
    EXPECT_EQ(back.code(), status.code());
    EXPECT_EQ(back.message(), status.message());
    EXPECT_EQ(FieldOf(back), FieldOf(status));
    if (ReasonOf(status)) {
      EXPECT_EQ(ReasonOf(back), ReasonOf(status));
    }
  }
}

TEST(StatusConversion, FieldValueAndLimitAreMetadata) {
  const absl::Status sent = OutOfRange("options.budget.max_primitives", 3, 15, 1000);
  const auto info = Find<google::rpc::ErrorInfo>(ToGrpcStatus(sent));
  ASSERT_TRUE(info);
  EXPECT_EQ(info->reason(), "OUT_OF_RANGE");
  EXPECT_EQ(info->metadata().at("field"), "options.budget.max_primitives");
  EXPECT_EQ(info->metadata().at("value"), "3");
  EXPECT_EQ(info->metadata().at("limit"), "[15, 1000]");
  ErrorFacts facts = FactsOf(sent);
  std::sort(facts.begin(), facts.end());
  EXPECT_EQ(FactsOf(FromGrpcStatus(ToGrpcStatus(sent))), facts);
}

TEST(StatusConversion, TheContractListsExactlyTheReasonsOfTheCore) {
  std::set<std::string> listed;
  const google::protobuf::EnumDescriptor& reasons = *v1::ErrorReason_descriptor();
  for (int i = 1; i < reasons.value_count(); ++i) {
    listed.insert(reasons.value(i)->name().substr(std::string("ERROR_REASON_").size()));
  }
  std::set<std::string> known;
  for (const KnownReason& reason : ErrorReasons()) known.insert(std::string(reason.name));
  EXPECT_EQ(listed, known);
}

TEST(StatusConversion, AReasonOfALaterServerIsTreatedAsItsCode) {
  google::rpc::Status rich;
  google::rpc::ErrorInfo info;
  info.set_reason("NEWER_THAN_THIS");
  rich.add_details()->PackFrom(info);
  const absl::Status status = FromGrpcStatus(
      {grpc::StatusCode::FAILED_PRECONDITION, "who knows", rich.SerializeAsString()});
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ReasonOf(status), std::nullopt);
}

TEST(StatusConversion, ManyWarningsStayWithinTheTrailersLimit) {
  const std::vector<Warning> warnings(200, {"HOLES_CLOSED", std::string(300, 'x'), 1});
  const grpc::Status status =
      ToGrpcStatus(WithWarnings(Refused(ErrorReason::kNotABody, "a chair"), warnings));
  EXPECT_LE(status.error_details().size(), 6000U);
  const std::vector<Warning> back = WarningsOf(FromGrpcStatus(status));
  EXPECT_GT(back.size(), 5U);
  EXPECT_LT(back.size(), 20U);
}

TEST(StatusConversion, EveryErrorHasAStableReason) {
  for (int code = 1; code <= 16; ++code) {
    const grpc::Status status =
        ToGrpcStatus(absl::Status(static_cast<absl::StatusCode>(code), "x"));
    EXPECT_EQ(status.error_code(), code);
    EXPECT_FALSE(Find<google::rpc::ErrorInfo>(status)->reason().empty());
  }
}

TEST(StatusConversion, HostileTextIsMadeFitToSend) {
  const grpc::Status status = ToGrpcStatus(
      InvalidField(ErrorReason::kOutOfRange, std::string("x\xff\n"), std::string(20'000, 'y')));
  EXPECT_LE(status.error_message().size(), 1000U);
  EXPECT_LE(status.error_details().size(), 4000U) << "trailers have a limit of 8 KiB";
  EXPECT_EQ(Find<google::rpc::BadRequest>(status)->field_violations(0).field(), "x??");
}

}  // namespace
}  // namespace capfit::wire
