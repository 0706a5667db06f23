// ApproximateBodyUnary beside the stream: the same answers and the same errors.
#include <gmock/gmock.h>
#include <google/protobuf/unknown_field_set.h>
#include <google/protobuf/util/message_differencer.h>
#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <gtest/gtest.h>

#include <thread>

#include "capfit/v1/service.grpc.pb.h"
#include "core/base/status.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/wire/status_conversion.h"
#include "server/server.h"
#include "tests/server/fake_fit.h"

namespace capfit::server {
namespace {

using Request = v1::ApproximateBodyUnaryRequest;
using Response = v1::ApproximateBodyUnaryResponse;

std::unique_ptr<Server> StartServer(FitBackend backend, ServerConfig config = {}) {
  config.listen = "127.0.0.1:0";
  config.threads = 1;
  return Server::Start(config, std::move(backend)).value();
}

Request Triangle() {
  Request request;
  v1::MeshArrays& arrays = *request.mutable_mesh()->mutable_arrays();
  for (int i = 0; i < 9; ++i) arrays.add_positions(static_cast<float>(i));
  for (const std::uint32_t i : {0U, 1U, 2U}) arrays.add_triangle_indices(i);
  return request;
}

// Over the loopback, as a client would.
grpc::Status CallRaw(const Server& server, const Request& request, Response& response,
                     grpc::ClientContext& context) {
  const auto channel = grpc::CreateChannel("127.0.0.1:" + std::to_string(server.port()),
                                           grpc::InsecureChannelCredentials());
  return v1::BodyApproximationService::NewStub(channel)->ApproximateBodyUnary(&context, request,
                                                                              &response);
}

absl::StatusOr<Response> Call(const Server& server, const Request& request) {
  grpc::ClientContext context;
  Response response;
  const grpc::Status status = CallRaw(server, request, response, context);
  if (!status.ok()) return wire::FromGrpcStatus(status);
  return response;
}

template <typename Condition>
bool WaitFor(const Condition& condition) {
  for (int i = 0; i < 20'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(UnaryCall, AnswersWhatTheStreamAnswers) {
  const auto server = StartServer(InstantBackend(5));
  Request request = Triangle();
  request.set_request_id("one message");
  const absl::StatusOr<Response> unary = Call(*server, request);
  ASSERT_TRUE(unary.ok()) << unary.status();

  grpc::ClientContext context;
  const auto stub = v1::BodyApproximationService::NewStub(server->InProcessChannel());
  const auto stream = stub->ApproximateBody(&context);
  v1::ApproximateBodyRequest header;
  header.mutable_header()->mutable_mesh()->mutable_arrays();
  header.mutable_header()->set_request_id("one message");
  stream->Write(header);
  v1::ApproximateBodyRequest chunk;
  *chunk.mutable_chunk()->mutable_arrays() = request.mesh().arrays();
  stream->Write(chunk);
  stream->WritesDone();
  Response streamed;
  v1::ApproximateBodyResponse part;
  while (stream->Read(&part)) {
    if (part.has_warning()) *streamed.add_warnings() = part.warning();
    if (part.has_landmarks()) *streamed.mutable_landmarks() = part.landmarks();
    if (part.has_feature_polygon()) *streamed.add_feature_polygons() = part.feature_polygon();
    if (part.has_primitives()) *streamed.mutable_primitives() = part.primitives();
    if (part.has_vertex_gaps())
      streamed.mutable_vertex_gaps()->Add(part.vertex_gaps().gaps().begin(),
                                          part.vertex_gaps().gaps().end());
    if (part.has_summary()) *streamed.mutable_summary() = part.summary();
  }
  ASSERT_TRUE(stream->Finish().ok());
  google::protobuf::util::MessageDifferencer differencer;
  std::string difference;
  differencer.set_float_comparison(google::protobuf::util::MessageDifferencer::EXACT);
  differencer.ReportDifferencesToString(&difference);
  google::protobuf::util::DefaultFieldComparator exact;
  exact.set_treat_nan_as_equal(true);
  differencer.set_field_comparator(&exact);
  EXPECT_TRUE(differencer.Compare(*unary, streamed)) << difference;
  EXPECT_EQ(unary->summary().request_id(), "one message");
  EXPECT_FALSE(unary->summary().version().empty());
}

TEST(UnaryCall, MisuseIsNamedByItsPath) {
  const auto server = StartServer({pipeline::ValidateOptions, InstantBackend().fit});
  struct Case {
    const char* name;
    std::function<void(Request&)> spoil;
    ErrorReason reason;
    const char* field;
  };
  for (const Case& c : std::vector<Case>{
           {"no mesh", [](Request& r) { r.clear_mesh(); }, ErrorReason::kMissing, "mesh"},
           {"empty file", [](Request& r) { r.mutable_mesh()->mutable_file(); },
            ErrorReason::kMissing, "mesh.file.data"},
           {"unknown format",
            [](Request& r) {
              r.mutable_mesh()->mutable_file()->set_format(static_cast<v1::MeshFileFormat>(99));
            },
            ErrorReason::kUnknownValue, "mesh.file.format"},
           {"half a vertex",
            [](Request& r) { r.mutable_mesh()->mutable_arrays()->add_positions(1); },
            ErrorReason::kCountMismatch, "mesh.arrays.positions"},
           {"two kinds of faces",
            [](Request& r) { r.mutable_mesh()->mutable_arrays()->add_face_sizes(3); },
            ErrorReason::kConflict, "mesh.arrays"},
           {"dense weights",
            [](Request& r) { r.mutable_options()->set_skinning(v1::SKINNING_FORM_DENSE); },
            ErrorReason::kConflict, "options.skinning"},
           {"unknown part",
            [](Request& r) { r.mutable_options()->add_parts(static_cast<v1::BodyPartGroup>(9)); },
            ErrorReason::kUnknownValue, "options.parts[0]"},
           {"part twice",
            [](Request& r) {
              r.mutable_options()->add_parts(v1::BODY_PART_GROUP_LEGS);
              r.mutable_options()->add_parts(v1::BODY_PART_GROUP_LEGS);
            },
            ErrorReason::kDuplicate, "options.parts[1]"},
           {"unknown engine", [](Request& r) { r.mutable_options()->set_engine("havok"); },
            ErrorReason::kUnknownValue, "options.engine"},
           {"tolerance of a best fit",
            [](Request& r) {
              r.mutable_options()->set_fit_mode(v1::FIT_MODE_BEST_FIT);
              r.mutable_options()->set_tolerance_m(0.001);
            },
            ErrorReason::kConflict, "options.tolerance_m"},
           {"landmark without a place",
            [](Request& r) { r.mutable_options()->add_landmarks()->set_name("crotch"); },
            ErrorReason::kMissing, "options.landmarks[0].position"},
       }) {
    Request request = Triangle();
    c.spoil(request);
    const absl::Status status = Call(*server, request).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << c.name << ": " << status;
    EXPECT_EQ(FieldOf(status), c.field) << c.name << ": " << status;
    EXPECT_EQ(ReasonOf(status), c.reason) << c.name << ": " << status;
  }
}

TEST(UnaryCall, AMessageAboveTheLimitIsNamedAndNotExhaustion) {
  const auto server = StartServer(InstantBackend());
  Request request;
  request.mutable_mesh()->mutable_file()->set_data(std::string(kMaxMessageBytes, ' '));
  const absl::Status status = Call(*server, request).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_EQ(ReasonOf(status), ErrorReason::kTooLarge);
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr(std::to_string(kMaxMessageBytes)));
  EXPECT_THAT(FactsOf(status),
              testing::Contains(testing::Pair("limit", std::to_string(kMaxMessageBytes))));
}

TEST(UnaryCall, WarningsTravelWithARefusal) {
  FitBackend backend = InstantBackend();
  backend.fit = [](const auto&...) -> absl::StatusOr<pipeline::FitResult> {
    return WithWarnings(Refused(ErrorReason::kNotABody, "a chair"),
                        std::vector<Warning>{{"HOLES_CLOSED", "3 holes were closed", 3}});
  };
  const auto server = StartServer(backend);
  Request request = Triangle();
  request.GetReflection()->MutableUnknownFields(&request)->AddVarint(99, 1);
  const absl::Status status = Call(*server, request).status();
  EXPECT_EQ(ReasonOf(status), ErrorReason::kNotABody);
  const std::vector<Warning> warnings = WarningsOf(status);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0].code, "UNKNOWN_FIELDS");
  EXPECT_EQ(warnings[1].code, "HOLES_CLOSED");
  EXPECT_EQ(warnings[1].count, 3);
}

TEST(UnaryCall, UnknownFieldsAreAWarningOfTheResult) {
  const auto server = StartServer(InstantBackend());
  Request request = Triangle();
  v1::FitOptions& options = *request.mutable_options();
  options.GetReflection()->MutableUnknownFields(&options)->AddVarint(1000, 1);
  const absl::StatusOr<Response> response = Call(*server, request);
  ASSERT_TRUE(response.ok()) << response.status();
  ASSERT_GT(response->warnings_size(), 0);
  EXPECT_EQ(response->warnings(0).code(), "UNKNOWN_FIELDS");
  EXPECT_THAT(response->warnings(0).message(), testing::HasSubstr("field 1000 of options"));
}

TEST(UnaryCall, AFullServerNamesTheWaitInTrailerAndDetails) {
  Gate gate;
  ServerConfig config;
  config.max_concurrent_fits = 1;
  config.max_queued_fits = 0;
  config.retry_pushback_ms = 1250;
  const auto server = StartServer(WaitingBackend(gate), config);
  std::thread first([&] { EXPECT_TRUE(Call(*server, Triangle()).ok()); });
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  grpc::ClientContext context;
  Response response;
  const grpc::Status status = CallRaw(*server, Triangle(), response, context);
  gate.open = true;
  first.join();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto pushback = trailers.find("grpc-retry-pushback-ms");
  ASSERT_NE(pushback, trailers.end());
  EXPECT_EQ(std::string(pushback->second.data(), pushback->second.size()), "1250");
  google::rpc::Status rich;
  ASSERT_TRUE(rich.ParseFromString(status.error_details()));
  google::rpc::RetryInfo retry;
  bool has_retry = false;
  for (const auto& any : rich.details()) has_retry |= any.UnpackTo(&retry);
  ASSERT_TRUE(has_retry);
  EXPECT_EQ(retry.retry_delay().seconds(), 1);
  EXPECT_EQ(retry.retry_delay().nanos(), 250'000'000);
}

TEST(UnaryCall, CancellingStopsTheFit) {
  Gate gate;
  const auto server = StartServer(WaitingBackend(gate));
  grpc::ClientContext context;
  std::thread call([&] {
    Response response;
    EXPECT_EQ(CallRaw(*server, Triangle(), response, context).error_code(),
              grpc::StatusCode::CANCELLED);
  });
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  context.TryCancel();
  call.join();
  EXPECT_TRUE(WaitFor([&] { return gate.waiting == 0; }));
}

}  // namespace
}  // namespace capfit::server
