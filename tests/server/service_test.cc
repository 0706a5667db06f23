// The service through an in-process channel: every promise of the call that needs no real fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "tests/server/fake_fit.h"
#include "tests/server/service_call.h"

namespace capfit::server {
namespace {

using Request = v1::ApproximateBodyRequest;
using Response = v1::ApproximateBodyResponse;
using testing::HasSubstr;

std::string FieldOf(const grpc::Status& status) {
  google::rpc::Status rich;
  rich.ParseFromString(status.error_details());
  google::rpc::BadRequest bad_request;
  for (const auto& any : rich.details()) {
    if (any.UnpackTo(&bad_request)) return bad_request.field_violations(0).field();
  }
  return "";
}

TEST(Service, AnswersInTheOrderOfTheContract) {
  const auto server = StartServer(InstantBackend(5));
  Call call(*server);
  call.Send({Header("my job"), Chunk()});
  ASSERT_TRUE(call.Finish().ok());
  // By number; the summary (7) alone stands behind the vertex gaps (8), at the end.
  ASSERT_EQ(call.responses.back().part_case(), Response::kSummary);
  int last = 0;
  for (std::size_t i = 0; i + 1 < call.responses.size(); ++i) {
    EXPECT_GE(static_cast<int>(call.responses[i].part_case()), last);
    EXPECT_NE(call.responses[i].part_case(), Response::kSummary);
    last = static_cast<int>(call.responses[i].part_case());
  }
  EXPECT_EQ(last, Response::kVertexGaps);
  EXPECT_EQ(call.responses.back().summary().request_id(), "my job");
  EXPECT_EQ(call.responses.back().summary().metrics().volume_error(), 0.5);
}

TEST(Service, MisuseOfTheStreamIsRefused) {
  const auto server = StartServer(InstantBackend());
  struct Case {
    std::vector<Request> requests;
    std::string field;
  };
  Request wrong_option = Header();
  wrong_option.mutable_header()->mutable_options()->set_quality(v1::Quality(44));
  for (const Case& c : {Case{{}, "header"}, Case{{Header()}, "chunk"}, Case{{Chunk()}, "chunk"},
                        Case{{Request()}, "part"}, Case{{Header(), Header()}, "header"},
                        Case{{wrong_option}, "options.quality"}}) {
    Call call(*server);
    call.Send(c.requests);
    const grpc::Status status = call.Finish();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
    EXPECT_EQ(FieldOf(status), c.field);
    EXPECT_TRUE(call.responses.empty());
  }
}

Request DeclaringHeader(int vertices, int faces) {
  Request header = Header();
  header.mutable_header()->mutable_mesh()->mutable_arrays()->set_vertex_count(vertices);
  header.mutable_header()->mutable_mesh()->mutable_arrays()->set_face_count(faces);
  return header;
}

TEST(Service, TheFitStartsWhenTheDeclaredCountsAreMet) {
  const auto server = StartServer(InstantBackend());
  Call call(*server);
  call.stream->Write(DeclaringHeader(3, 1));
  call.stream->Write(Chunk());  // and the send side stays open
  EXPECT_TRUE(call.Finish().ok());
}

TEST(Service, TheFitStartsWhenTheDeclaredBytesAreMet) {
  const std::string file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto server = StartServer(InstantBackend());
  Call call(*server);
  Request header;
  header.mutable_header()->mutable_mesh()->mutable_file()->set_byte_count(
      static_cast<std::int64_t>(file.size()));
  call.stream->Write(header);
  for (const std::string& piece : {file.substr(0, 10), file.substr(10)}) {
    Request chunk;
    chunk.mutable_chunk()->set_file_bytes(piece);
    call.stream->Write(chunk);
  }
  EXPECT_TRUE(call.Finish().ok());
}

TEST(Service, PolygonsAreCompleteWithTheirLastCorner) {
  Gate gate;
  const auto server = StartServer(WaitingBackend(gate));
  Call call(*server);
  call.stream->Write(DeclaringHeader(4, 1));
  Request positions = Chunk();
  v1::MeshArrays& arrays = *positions.mutable_chunk()->mutable_arrays();
  arrays.clear_triangle_indices();
  for (const float x : {1.F, 2.F, 3.F}) arrays.add_positions(x);
  arrays.add_face_sizes(4);
  call.stream->Write(positions);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(gate.waiting, 0);
  Request corners;
  for (const std::uint32_t i : {0U, 1U, 2U, 3U}) {
    corners.mutable_chunk()->mutable_arrays()->add_face_indices(i);
  }
  call.stream->Write(corners);
  EXPECT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  gate.open = true;
  EXPECT_TRUE(call.Finish().ok());
}

TEST(Service, AChunkTooManyStopsTheFit) {
  Gate gate;
  const auto server = StartServer(WaitingBackend(gate));
  Call call(*server);
  call.stream->Write(DeclaringHeader(3, 1));
  call.stream->Write(Chunk());
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  call.stream->Write(Chunk());
  const grpc::Status status = call.Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
  EXPECT_EQ(FieldOf(status), "chunk");
  EXPECT_TRUE(WaitFor([&] { return gate.waiting == 0; }));
}

TEST(Service, AMessageAboveTheLimitIsNamed) {
  const auto server = StartServer(InstantBackend());
  Call call(LoopbackChannel(*server));
  Request header;
  header.mutable_header()->mutable_mesh()->mutable_file();
  Request chunk;
  chunk.mutable_chunk()->set_file_bytes(std::string(kMaxMessageBytes, ' '));
  call.Send({header, chunk});
  const grpc::Status status = call.Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
  EXPECT_THAT(status.error_message(), HasSubstr(std::to_string(kMaxMessageBytes)));
}

TEST(Service, AWrongHeaderIsAnsweredBeforeTheUploadEnds) {
  const auto server = StartServer(InstantBackend());
  Call call(*server);
  Request header = Header();
  header.mutable_header()->mutable_options()->set_skinning(static_cast<v1::SkinningForm>(99));
  call.stream->Write(header);  // and the send side stays open
  EXPECT_EQ(call.Finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST(Service, TheBackendsVerdictOnOptionsCountsBeforeTheUploadEnds) {
  FitBackend backend = InstantBackend();
  backend.validate = [](const pipeline::FitOptions&) {
    return absl::UnimplementedError("quality tight comes later");
  };
  const auto server = StartServer(backend);
  Call call(*server);
  call.stream->Write(Header());
  const grpc::Status status = call.Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNIMPLEMENTED);
  EXPECT_EQ(status.error_message(), "quality tight comes later");
}

TEST(Service, AFullServerSaysWhenToComeBack) {
  Gate gate;
  ServerConfig config;
  config.max_concurrent_fits = 1;
  config.max_queued_fits = 1;
  config.retry_pushback_ms = 321;
  const auto server = StartServer(WaitingBackend(gate), config);
  Call running(*server);
  running.Send({Header(), Chunk()});
  Call waiting(*server);
  waiting.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  // The second call's place is taken when its upload has arrived; ask until it has.
  grpc::Status status;
  std::string pushback;
  ASSERT_TRUE(WaitFor([&] {
    Call refused(server->InProcessChannel(), {}, 0.2);
    refused.stream->Write(Header());  // no more than the header: refused before the upload
    status = refused.Finish();
    pushback = refused.Trailer("grpc-retry-pushback-ms");
    return status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED;
  }));
  EXPECT_EQ(pushback, "321");
  EXPECT_THAT(status.error_message(), HasSubstr("all 2 places"));
  gate.open = true;
  EXPECT_TRUE(running.Finish().ok());
  EXPECT_TRUE(waiting.Finish().ok());
}

TEST(Service, CancellingStopsTheFit) {
  Gate gate;
  const auto server = StartServer(WaitingBackend(gate));
  Call call(*server);
  call.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  const auto begin = std::chrono::steady_clock::now();
  call.context.TryCancel();
  EXPECT_EQ(call.Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(WaitFor([&] { return gate.waiting == 0; }));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(Service, ADeadlineStopsTheFit) {
  Gate gate;
  const auto server = StartServer(WaitingBackend(gate));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(300));
  const auto stub = v1::BodyApproximationService::NewStub(server->InProcessChannel());
  const auto stream = stub->ApproximateBody(&context);
  stream->Write(Header());
  stream->Write(Chunk());
  stream->WritesDone();
  Response response;
  while (stream->Read(&response)) {
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_TRUE(WaitFor([&] { return gate.waiting == 0; }));
}

TEST(Service, ACallerThatGoesAwayWhileUploadingFreesItsPlace) {
  ServerConfig config;
  config.max_concurrent_fits = 1;
  config.max_queued_fits = 0;
  const auto server = StartServer(InstantBackend(), config);
  for (int i = 0; i < 5; ++i) {
    Call half(*server);
    half.stream->Write(Header());
    half.context.TryCancel();
    half.Finish();
    EXPECT_TRUE(WaitFor([&] {
      Call whole(*server);
      whole.Send({Header(), Chunk()});
      return whole.Finish().ok();
    }));
  }
}

TEST(Service, ErrorsAndExceptionsOfTheFitCostOneCallOnly) {
  FitBackend backend = InstantBackend();
  int call_number = 0;
  backend.fit = [&](const formats::PolygonSoup&, const pipeline::FitOptions&, const ThreadPool&,
                    FitObserver&) -> absl::StatusOr<pipeline::FitResult> {
    if (call_number++ == 0) throw std::bad_alloc();
    if (call_number == 2) throw std::runtime_error("boom");
    return HandMadeResult();
  };
  const auto server = StartServer(backend);
  std::vector<grpc::StatusCode> codes;
  for (int i = 0; i < 3; ++i) {
    Call call(*server);
    call.Send({Header(), Chunk()});
    codes.push_back(call.Finish().error_code());
  }
  EXPECT_THAT(codes, testing::ElementsAre(grpc::StatusCode::RESOURCE_EXHAUSTED,
                                          grpc::StatusCode::INTERNAL, grpc::StatusCode::OK));
}

TEST(Service, ASlowReaderGetsEverything) {
  const auto server = StartServer(InstantBackend(400'000));  // 4.8 MB of weights
  Call call(*server);
  call.Send({Header(), Chunk()});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  std::size_t weights = 0;
  Response response;
  while (call.stream->Read(&response)) {
    weights += static_cast<std::size_t>(response.skinning().dense().weights_size());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(call.stream->Finish().ok());
  EXPECT_EQ(weights, 3U * 400'000U);
}

TEST(Service, InfoListsOnlyWhatIsAccepted) {
  FitBackend backend = InstantBackend();
  backend.validate = [](const pipeline::FitOptions& options) {
    return options.quality == pipeline::Quality::kTight ? absl::UnimplementedError("later")
                                                        : absl::OkStatus();
  };
  ServerConfig config;
  config.upload.max_bytes = 12345;
  const auto server = StartServer(backend, config);
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  const auto stub = v1::BodyApproximationService::NewStub(server->InProcessChannel());
  ASSERT_TRUE(stub->GetServerInfo(&context, {}, &info).ok());
  EXPECT_THAT(info.features(), testing::Contains("quality.paper"));
  EXPECT_THAT(info.features(), testing::Not(testing::Contains("quality.tight")));
  EXPECT_EQ(info.limits().max_upload_bytes(), 12345);
  EXPECT_EQ(info.limits().threads(), 1);
  EXPECT_EQ(info.formats_size(), 5);
  EXPECT_FALSE(info.version().empty());
}

TEST(Service, RunsAsManyFitsAsItHasThreadsButForOneThatTwoShare) {
  const auto fits_with = [](int threads, int wished) {
    ServerConfig config;
    config.threads = threads;
    config.max_concurrent_fits = wished;
    config.listen = "127.0.0.1:0";
    absl::StatusOr<std::unique_ptr<Server>> server = Server::Start(config, InstantBackend());
    EXPECT_TRUE(server.ok()) << server.status();
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    const auto stub = v1::BodyApproximationService::NewStub((*server)->InProcessChannel());
    EXPECT_TRUE(stub->GetServerInfo(&context, {}, &info).ok());
    return info.limits().max_concurrent_fits();
  };
  EXPECT_EQ(fits_with(1, 0), 2);
  EXPECT_EQ(fits_with(5, 0), 5);
  EXPECT_EQ(fits_with(100, 0), 64);
  EXPECT_EQ(fits_with(5, 1), 1) << "the operator's word counts";
}

TEST(Service, DrainingLetsTheRunningCallFinish) {
  Gate gate;
  const auto server = StartServer(WaitingBackend(gate));
  Call call(LoopbackChannel(*server));
  call.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  std::thread drain([&] { server->Drain(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  gate.open = true;
  const grpc::Status status = call.Finish();
  EXPECT_TRUE(status.ok()) << status.error_message();
  drain.join();
}

TEST(Service, DrainingCancelsWhatDoesNotFinishInTime) {
  Gate gate;
  ServerConfig config;
  config.drain_seconds = 0.1;
  const auto server = StartServer(WaitingBackend(gate), config);
  Call call(LoopbackChannel(*server));
  call.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  std::thread drain([&] { server->Drain(); });
  EXPECT_FALSE(call.Finish().ok());
  drain.join();
  EXPECT_EQ(gate.waiting, 0);
}

TEST(Service, AnAddressThatIsTakenIsAnError) {
  const auto server = StartServer(InstantBackend());
  ServerConfig config;
  config.listen = "127.0.0.1:" + std::to_string(server->port());
  EXPECT_EQ(Server::Start(config, InstantBackend()).status().code(),
            absl::StatusCode::kUnavailable);
}

}  // namespace
}  // namespace capfit::server
