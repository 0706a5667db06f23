// A server in this process with a stand-in for the pipeline, and calls of it driven by hand.
#ifndef CAPFIT_TESTS_SERVER_SERVICE_CALL_H_
#define CAPFIT_TESTS_SERVER_SERVICE_CALL_H_

#include <grpcpp/client_context.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "capfit/v1/service.grpc.pb.h"
#include "server/server.h"

namespace capfit::server {

// On a free port of the loopback, with one thread that computes.
[[nodiscard]] std::unique_ptr<Server> StartServer(FitBackend backend, ServerConfig config = {});

// Over the loopback: an in-process channel is cut at once when its server stops. A connection of
// its own for each channel.
[[nodiscard]] std::shared_ptr<grpc::Channel> LoopbackChannel(const Server& server);

// A header of arrays that declares nothing, and a chunk of one triangle.
[[nodiscard]] v1::ApproximateBodyRequest Header(const std::string& request_id = "");
[[nodiscard]] v1::ApproximateBodyRequest Chunk();
// A chunk of so many vertices and no face: 12 bytes each on the wire.
[[nodiscard]] v1::ApproximateBodyRequest Positions(int vertices);

struct Call {
  explicit Call(Server& server) : Call(server.InProcessChannel()) {}
  // `metadata` as pairs; `timeout_seconds` 0: no deadline.
  explicit Call(const std::shared_ptr<grpc::Channel>& channel,
                const std::vector<std::pair<std::string, std::string>>& metadata = {},
                double timeout_seconds = 0.0);

  void Send(const std::vector<v1::ApproximateBodyRequest>& requests);
  // Reads to the end.
  grpc::Status Finish();
  // After Finish: the trailer, empty without one.
  [[nodiscard]] std::string Trailer(const std::string& key) const;

  grpc::ClientContext context;
  std::unique_ptr<v1::BodyApproximationService::Stub> stub;
  std::unique_ptr<grpc::ClientReaderWriter<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>>
      stream;
  std::vector<v1::ApproximateBodyResponse> responses;
};

// Whether it came true within 20 s.
template <typename Condition>
[[nodiscard]] bool WaitFor(const Condition& condition) {
  for (int i = 0; i < 20'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace capfit::server

#endif  // CAPFIT_TESTS_SERVER_SERVICE_CALL_H_
