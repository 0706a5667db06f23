// A real server process: misuse of the stream, cancellation, deadline, health, an orderly end.
#include <gmock/gmock.h>
#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <limits>
#include <thread>

#include "capfit/v1/service.grpc.pb.h"
#include "client/body_client.h"
#include "core/base/status.h"
#include "core/mannequin/mannequin.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "tests/e2e/processes.h"

namespace capfit::e2e {
namespace {

using testing::HasSubstr;
using Request = v1::ApproximateBodyRequest;
using Response = v1::ApproximateBodyResponse;

std::shared_ptr<grpc::Channel> ChannelTo(const ServerProcess& server) {
  return grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials());
}

formats::PolygonSoup Mannequin(int faces) {
  mannequin::MannequinOptions options;
  options.faces = faces;
  auto soup = mannequin::MakeMannequin(options);
  EXPECT_TRUE(soup.ok()) << soup.status();
  return *std::move(soup);
}

grpc::health::v1::HealthCheckResponse::ServingStatus HealthOf(const ServerProcess& server,
                                                              const std::string& service) {
  grpc::ClientContext context;
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(service);
  grpc::health::v1::HealthCheckResponse response;
  const auto stub = grpc::health::v1::Health::NewStub(ChannelTo(server));
  const grpc::Status status = stub->Check(&context, request, &response);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return response.status();
}

// A server starts itself anew with its malloc's settings, as the same process by the same name.
TEST(ServerProcess, ItsHeapsTakeLargePages) {
  ServerProcess server;
  const std::string process = "/proc/" + std::to_string(server.pid());
  EXPECT_THAT(ReadText(process + "/environ"), HasSubstr("GLIBC_TUNABLES=glibc.malloc.hugetlb=1"));
  EXPECT_EQ(ReadText(process + "/comm"), "capfit-server\n");
  server.Signal(SIGTERM);
  EXPECT_EQ(server.Wait(), 0);
}

TEST(ServerProcess, ReportsHealthAndEndsInOrder) {
  for (const int signal : {SIGTERM, SIGINT}) {
    ServerProcess server;
    EXPECT_EQ(HealthOf(server, ""), grpc::health::v1::HealthCheckResponse::SERVING);
    EXPECT_EQ(HealthOf(server, "capfit.v1.BodyApproximationService"),
              grpc::health::v1::HealthCheckResponse::SERVING);
    server.Signal(signal);
    EXPECT_EQ(server.Wait(), 0);
  }
}

TEST(ServerProcess, SaysNotServingWhileItDrains) {
  ServerProcess server({"--drain-delay-seconds", "2"});
  server.Signal(SIGTERM);
  bool was_seen = false;
  for (int i = 0; i < 50 && !was_seen; ++i) {
    was_seen = HealthOf(server, "") == grpc::health::v1::HealthCheckResponse::NOT_SERVING;
  }
  EXPECT_TRUE(was_seen);
  EXPECT_EQ(server.Wait(), 0);
}

TEST(ServerProcess, FinishesARunningCallBeforeItEnds) {
  ServerProcess server;
  const formats::PolygonSoup soup = Mannequin(20'000);
  client::CallOptions call;
  call.on_progress = [&server, sent = false](Stage, double) mutable {
    if (!std::exchange(sent, true)) server.Signal(SIGTERM);
  };
  const auto result = client::BodyClient(ChannelTo(server)).ApproximateMesh(soup, {}, call);
  EXPECT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(server.Wait(), 0);
}

TEST(ServerProcess, ArraysGiveABodyInsideItsPrimitives) {
  const ServerProcess server;
  const auto result = client::BodyClient(ChannelTo(server)).ApproximateMesh(Mannequin(10'000), {});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->metrics.vertices_out, 0);
  EXPECT_LE(result->primitives.primitive_count(), 64);
  EXPECT_GT(result->primitives.primitive_count(), 20);
}

TEST(ServerProcess, WrongArraysAreNamed) {
  const ServerProcess server;
  const client::BodyClient client(ChannelTo(server));
  formats::PolygonSoup out_of_range = Mannequin(4'000);
  out_of_range.face_vertices[17] = 90'210;
  absl::Status status = client.ApproximateMesh(out_of_range, {}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("[17]"));
  EXPECT_THAT(std::string(status.message()), HasSubstr("90210"));
  EXPECT_THAT(std::string(status.message()),
              HasSubstr(std::to_string(out_of_range.positions.size())));

  formats::PolygonSoup not_finite = Mannequin(4'000);
  not_finite.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
  status = client.ApproximateMesh(not_finite, {}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("mesh.arrays.positions_double[16]"));
  EXPECT_EQ(FieldOf(status), "mesh.arrays.positions_double[16]");
}

TEST(ServerProcess, MisuseOfTheStreamIsNamed) {
  const ServerProcess server({"--max-upload-mb", "1"});
  const auto stub = v1::BodyApproximationService::NewStub(ChannelTo(server));
  Request header;
  header.mutable_header()->mutable_mesh()->mutable_file();
  Request chunk;
  chunk.mutable_chunk()->set_file_bytes(std::string(700'000, ' '));
  struct Case {
    std::vector<Request> requests;
    std::string problem;
  };
  for (const Case& c : {Case{{}, "header is missing"}, Case{{header}, "the upload is empty"},
                        Case{{chunk}, "chunk came before the header"},
                        Case{{header, header}, "header came a second time"},
                        Case{{header, chunk, chunk}, "1400000 bytes, must have at most 1048576"}}) {
    grpc::ClientContext context;
    const auto stream = stub->ApproximateBody(&context);
    for (const Request& request : c.requests) stream->Write(request);
    stream->WritesDone();
    Response response;
    EXPECT_FALSE(stream->Read(&response));
    const grpc::Status status = stream->Finish();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_THAT(status.error_message(), HasSubstr(c.problem));
  }
}

// Whether the server's log shows that a fit ended with `status` before its end, within five
// seconds.
bool LogsSoon(const ServerProcess& server, const std::string& status) {
  for (int i = 0; i < 500; ++i) {
    if (server.Log().find("status=" + status) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

// Uploads a large mannequin and gives up after the first progress message.
void CancelAfterFirstProgress(const ServerProcess& server, const formats::PolygonSoup& soup) {
  const auto stub = v1::BodyApproximationService::NewStub(ChannelTo(server));
  grpc::ClientContext context;
  const auto stream = stub->ApproximateBody(&context);
  Request request;
  request.mutable_header()->mutable_mesh()->mutable_arrays();
  request.mutable_header()->mutable_options()->mutable_budget()->set_max_primitives(500);
  stream->Write(request);
  v1::MeshArrays& arrays = *request.mutable_chunk()->mutable_arrays();
  for (const Eigen::Vector3d& p : soup.positions) {
    for (int axis = 0; axis < 3; ++axis) arrays.add_positions(static_cast<float>(p[axis]));
  }
  stream->Write(request);
  request.Clear();
  v1::MeshArrays& faces = *request.mutable_chunk()->mutable_arrays();
  faces.mutable_face_sizes()->Assign(soup.face_sizes.begin(), soup.face_sizes.end());
  faces.mutable_face_indices()->Assign(soup.face_vertices.begin(), soup.face_vertices.end());
  stream->Write(request);
  stream->WritesDone();
  Response response;
  EXPECT_TRUE(stream->Read(&response));
  EXPECT_TRUE(response.has_progress());
  context.TryCancel();
  while (stream->Read(&response)) {
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST(ServerProcess, ACancelledFitMakesRoomForTheNext) {
  const ServerProcess server({"--max-concurrent-fits", "1", "--max-queued-fits", "0"});
  CancelAfterFirstProgress(server, Mannequin(60'000));
  EXPECT_TRUE(LogsSoon(server, "CANCELLED")) << server.Log();
  // The only place is free again as soon as the core has seen the cancel.
  const auto begin = std::chrono::steady_clock::now();
  absl::Status status;
  do {
    status = client::BodyClient(ChannelTo(server)).ApproximateMesh(Mannequin(4'000), {}).status();
  } while (absl::IsResourceExhausted(status) &&
           std::chrono::steady_clock::now() - begin < std::chrono::seconds(30));
  EXPECT_TRUE(status.ok()) << status;
}

TEST(ServerProcess, ADeadlineEndsTheFit) {
  const ServerProcess server;
  client::CallOptions call;
  call.timeout_seconds = 0.05;
  pipeline::FitOptions options;
  options.max_primitives = 500;
  EXPECT_EQ(client::BodyClient(ChannelTo(server))
                .ApproximateMesh(Mannequin(60'000), options, call)
                .status()
                .code(),
            absl::StatusCode::kDeadlineExceeded);
  EXPECT_TRUE(LogsSoon(server, "DEADLINE_EXCEEDED")) << server.Log();
  // And the server goes on.
  EXPECT_TRUE(client::BodyClient(ChannelTo(server)).GetServerInfo().ok());
}

}  // namespace
}  // namespace capfit::e2e
