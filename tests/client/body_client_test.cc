// The client library against a real service with a stand-in for the pipeline.
#include "client/body_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/base/status.h"
#include "server/server.h"
#include "tests/server/fake_fit.h"

namespace capfit::client {
namespace {

using server::FitBackend;

std::unique_ptr<server::Server> StartServer(FitBackend backend, server::ServerConfig config = {}) {
  config.listen = "127.0.0.1:0";
  config.threads = 1;
  auto started = server::Server::Start(config, std::move(backend));
  EXPECT_TRUE(started.ok()) << started.status();
  return *std::move(started);
}

// Keeps the mesh that arrived.
FitBackend Keeping(formats::PolygonSoup& target) {
  FitBackend backend = server::InstantBackend();
  backend.fit = [&target](const formats::PolygonSoup& soup, const pipeline::FitOptions&,
                          const ThreadPool&, FitObserver&) -> absl::StatusOr<pipeline::FitResult> {
    target = soup;
    return server::HandMadeResult();
  };
  return backend;
}

formats::PolygonSoup ManyVertices(std::size_t count) {
  formats::PolygonSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    soup.positions.emplace_back(static_cast<double>(i) / 3.0, 0.1, -1.0);
  }
  for (std::uint32_t i = 0; i + 2 < count; ++i) {
    for (const std::uint32_t corner : {i, i + 1, i + 2}) soup.face_vertices.push_back(corner);
  }
  return soup;
}

TEST(BodyClient, ArraysArriveBitForBit) {
  formats::PolygonSoup arrived;
  const auto server = StartServer(Keeping(arrived));
  formats::PolygonSoup sent = ManyVertices(50'000);  // several chunks of each array
  const BodyClient client(server->InProcessChannel());
  ASSERT_TRUE(client.ApproximateMesh(sent, {}).ok());
  EXPECT_EQ(arrived.positions, sent.positions);
  EXPECT_EQ(arrived.face_vertices, sent.face_vertices);
  EXPECT_TRUE(arrived.face_sizes.empty());

  sent.face_sizes.assign(sent.face_vertices.size() / 4, 4);
  sent.face_vertices.resize(sent.face_sizes.size() * 4);
  ASSERT_TRUE(client.ApproximateMesh(sent, {}).ok());
  EXPECT_EQ(arrived.face_sizes, sent.face_sizes);
  EXPECT_EQ(arrived.face_vertices, sent.face_vertices);
}

TEST(BodyClient, AFileArrivesWhole) {
  formats::PolygonSoup arrived;
  const auto server = StartServer(Keeping(arrived));
  std::string obj;
  for (int i = 0; i < 60'000; ++i) obj += "v " + std::to_string(i) + " 0.5 1\n";  // > 256 KiB
  obj += "f 1 2 3\n";
  const BodyClient client(server->InProcessChannel());
  const auto result =
      client.ApproximateFile(std::as_bytes(std::span(obj)), formats::MeshFormat::kObj, {});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(arrived.positions.size(), 60'000U);
  EXPECT_EQ(result->primitives.spheres.size(), 3U);
}

TEST(BodyClient, ErrorsComeWithCodeMessageAndField) {
  FitBackend backend = server::InstantBackend();
  backend.fit = [](const formats::PolygonSoup&, const pipeline::FitOptions&, const ThreadPool&,
                   FitObserver&) -> absl::StatusOr<pipeline::FitResult> {
    return InvalidField(ErrorReason::kOutOfRange, "triangle_indices[17]",
                        "is 90210, must be below 6890");
  };
  const auto server = StartServer(backend);
  const absl::Status status =
      BodyClient(server->InProcessChannel()).ApproximateMesh(ManyVertices(9), {}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(), "triangle_indices[17] is 90210, must be below 6890");
  EXPECT_EQ(FieldOf(status), "triangle_indices[17]");
}

TEST(BodyClient, OptionsThatTheWireCannotSayAreRefusedHere) {
  const auto server = StartServer(server::InstantBackend());
  const BodyClient client(server->InProcessChannel());
  pipeline::FitOptions two_budgets;
  two_budgets.max_primitives = 64;
  two_budgets.polygon_error = 0.1;
  EXPECT_EQ(client.ApproximateMesh(ManyVertices(9), two_budgets).status().code(),
            absl::StatusCode::kInvalidArgument);
  pipeline::FitOptions no_parts;
  no_parts.parts = {.torso = false, .arms = false, .legs = false};
  EXPECT_EQ(client.ApproximateMesh(ManyVertices(9), no_parts).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(BodyClient, ATimeoutEndsTheCall) {
  server::Gate gate;
  const auto server = StartServer(server::WaitingBackend(gate));
  CallOptions call;
  call.timeout_seconds = 0.3;
  EXPECT_EQ(BodyClient(server->InProcessChannel())
                .ApproximateMesh(ManyVertices(9), {}, call)
                .status()
                .code(),
            absl::StatusCode::kDeadlineExceeded);
}

TEST(BodyClient, AFullServerIsAskedAgain) {
  server::Gate gate;
  server::ServerConfig config;
  config.max_concurrent_fits = 1;
  config.max_queued_fits = 0;
  config.retry_pushback_ms = 200;
  const auto server = StartServer(server::WaitingBackend(gate), config);
  const BodyClient client = BodyClient::Connect("127.0.0.1:" + std::to_string(server->port()));
  std::thread first([&] { EXPECT_TRUE(client.ApproximateMesh(ManyVertices(9), {}).ok()); });
  while (gate.waiting == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::thread opener([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    gate.open = true;
  });
  // 1.8 MB of upload: refused in the middle of sending.
  EXPECT_TRUE(client.ApproximateMesh(ManyVertices(50'000), {}).ok());
  first.join();
  opener.join();
}

TEST(BodyClient, NobodyThereIsUnavailable) {
  CallOptions call;
  call.timeout_seconds = 10.0;
  EXPECT_EQ(
      BodyClient::Connect("127.0.0.1:1").ApproximateMesh(ManyVertices(9), {}, call).status().code(),
      absl::StatusCode::kUnavailable);
}

TEST(BodyClient, ProgressIsPassedOn) {
  const auto server = StartServer(server::InstantBackend());
  CallOptions call;
  double last = -1.0;
  call.on_progress = [&](Stage, double done) {
    EXPECT_GE(done, last);
    last = done;
  };
  ASSERT_TRUE(
      BodyClient(server->InProcessChannel()).ApproximateMesh(ManyVertices(9), {}, call).ok());
  EXPECT_GE(last, 0.0);
}

}  // namespace
}  // namespace capfit::client
