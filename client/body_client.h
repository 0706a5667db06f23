// Calls a capfit server from C++.
//
//   const BodyClient client = BodyClient::Connect("127.0.0.1:50051");
//   absl::StatusOr<pipeline::FitResult> result = client.ApproximateFile(bytes, format, options);
#ifndef CAPFIT_CLIENT_BODY_CLIENT_H_
#define CAPFIT_CLIENT_BODY_CLIENT_H_

#include <grpcpp/channel.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "capfit/v1/service.grpc.pb.h"
#include "client/connection.h"
#include "client/retries.h"
#include "core/formats/read_mesh.h"
#include "core/pipeline/fit.h"

namespace capfit::client {

// Called for each progress message, on the calling thread.
using ProgressFunction = std::function<void(Stage stage, double fraction_done)>;

// What may be set about one call.
struct CallOptions {
  double timeout_seconds = 300.0;   // of the whole call, upload and queueing included; > 0
  std::string request_id;           // at most 128 bytes; comes back in logs of the server
  ProgressFunction on_progress;     // may be empty
  int max_attempts = kMaxAttempts;  // >= 1; see retries.h
  bool is_bulk = false;             // may wait behind calls that somebody waits for
  bool is_fresh = false;            // wants a fit of its own, no result that is kept
};

// Cheap to copy; safe to use from several threads at once. Calls block. A server that is full or
// not reachable is asked up to four times, with the pauses that it names; of several servers it is
// another one.
//
// Errors have the server's code and message, and its FieldOf and ReasonOf; besides: UNAVAILABLE
// (not reachable), DEADLINE_EXCEEDED, INTERNAL (the answer breaks the contract).
class BodyClient {
 public:
  // "host", "host:port", "[::1]:7": see core/base/host_and_port.h; without a port 50051. Does not
  // block: the connection is made by the first call. `address` must be one.
  [[nodiscard]] static BodyClient Connect(const std::string& address);
  // The same with TLS and a token, and for several servers: see connection.h.
  [[nodiscard]] static absl::StatusOr<BodyClient> Connect(const std::string& addresses,
                                                          const Security& security);
  explicit BodyClient(const std::shared_ptr<grpc::Channel>& channel, const std::string& token = "");

  // Uploads a mesh file as it is, in chunks of 256 KiB. kUnknown: the server looks at the bytes.
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> ApproximateFile(
      std::span<const std::byte> bytes, formats::MeshFormat format,
      const pipeline::FitOptions& options, const CallOptions& call = {}) const;

  // Uploads arrays, in double precision and chunks of 256 KiB. Joints are not sent.
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> ApproximateMesh(
      const formats::PolygonSoup& soup, const pipeline::FitOptions& options,
      const CallOptions& call = {}) const;

  [[nodiscard]] absl::StatusOr<v1::GetServerInfoResponse> GetServerInfo(
      double timeout_seconds = 10.0) const;

 private:
  std::shared_ptr<v1::BodyApproximationService::Stub> stub_;
  std::string token_;
};

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_BODY_CLIENT_H_
