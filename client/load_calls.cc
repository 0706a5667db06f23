#include "client/load_calls.h"

#include <memory>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/connection.h"
#include "client/retries.h"
#include "core/base/fit_observer.h"
#include "core/base/status.h"
#include "core/base/thread_pool.h"
#include "core/formats/read_mesh.h"
#include "proto/wire/options_conversion.h"
#include "proto/wire/status_conversion.h"

namespace capfit::client {
namespace {

using Stub = v1::BodyApproximationService::Stub;

class Uncancelled final : public FitObserver {
 public:
  void OnStage(Stage /*stage*/, double /*fraction_done*/) override {}
  [[nodiscard]] bool IsCancelled() const override { return false; }
};

std::span<const std::byte> BytesOf(const LoadBody& body) {
  return std::as_bytes(std::span(body.bytes));
}

// The numbers of spheres and capsules as they are in memory.
std::string Bits(const capsule::PrimitiveSet& set) {
  std::string bits;
  for (const auto& sphere : set.spheres) {
    for (const double number :
         {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m}) {
      bits.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
  }
  for (const auto& pair : set.capsules) absl::StrAppend(&bits, pair[0], ",", pair[1], ";");
  return bits;
}

// BodyClient does not tell the pause that a refusal names, so none is missed.
LoadAnswer AnswerOf(const absl::StatusOr<pipeline::FitResult>& result) {
  if (!result.ok()) return {result.status(), "", 0, true};
  std::string bits = Bits(result->primitives);
  const auto bytes = static_cast<std::int64_t>(bits.size());
  return {absl::OkStatus(), std::move(bits), bytes, false};
}

v1::ApproximateBodyUnaryRequest RequestOf(const pipeline::FitOptions& options) {
  v1::ApproximateBodyHeader header;
  wire::OptionsToWire(options, header);
  v1::ApproximateBodyUnaryRequest request;
  request.mutable_mesh()->set_unit(header.mesh().unit());
  request.mutable_mesh()->set_up_axis(header.mesh().up_axis());
  *request.mutable_options() = std::move(*header.mutable_options());
  *request.mutable_exports() = std::move(*header.mutable_exports());
  if (header.has_layout()) *request.mutable_layout() = std::move(*header.mutable_layout());
  return request;
}

}  // namespace

absl::StatusOr<LoadCall> UnaryLoad(const ServerFlags& server, const LoadCallOptions& options) {
  CAPFIT_RETURN_IF_ERROR(pipeline::ValidateOptions(options.fit));
  CAPFIT_ASSIGN_OR_RETURN(const Security security, SecurityOf(server));
  CAPFIT_ASSIGN_OR_RETURN(const std::shared_ptr<grpc::Channel> channel,
                          OpenChannel(server.addresses, security));
  const std::shared_ptr<Stub> stub = v1::BodyApproximationService::NewStub(channel);
  return [=, blank = RequestOf(options.fit)](const LoadBody& body) {
    v1::ApproximateBodyUnaryRequest request = blank;
    request.mutable_mesh()->mutable_file()->set_data(body.bytes);
    LoadAnswer answer;
    const auto response = WithRetries(
        options.timeout_seconds, options.max_attempts,
        [&](grpc::ClientContext& context) -> absl::StatusOr<v1::ApproximateBodyUnaryResponse> {
          AddToken(security.token, context);
          if (options.is_fresh) context.AddMetadata("cache-control", "no-cache");
          v1::ApproximateBodyUnaryResponse message;
          const grpc::Status status = stub->ApproximateBodyUnary(&context, request, &message);
          answer.has_pushback = PushbackOf(context).has_value();
          if (!status.ok()) return wire::FromGrpcStatus(status);
          return message;
        });
    answer.status = response.status();
    if (!answer.status.ok()) return answer;
    answer.bytes = static_cast<std::int64_t>(response->ByteSizeLong());
    if (response->primitives().spheres_size() > 0) {
      answer.result = response->primitives().SerializeAsString();
    }
    return answer;
  };
}

absl::StatusOr<LoadCall> StreamedLoad(const ServerFlags& server, const LoadCallOptions& options) {
  CAPFIT_ASSIGN_OR_RETURN(const BodyClient client, ConnectTo(server));
  return [=](const LoadBody& body) {
    CallOptions call;
    call.timeout_seconds = options.timeout_seconds;
    call.max_attempts = options.max_attempts;
    call.is_fresh = options.is_fresh;
    return AnswerOf(
        client.ApproximateFile(BytesOf(body), formats::MeshFormat::kUnknown, options.fit, call));
  };
}

absl::StatusOr<LoadCall> LocalLoad(const LoadCallOptions& options) {
  CAPFIT_RETURN_IF_ERROR(pipeline::ValidateOptions(options.fit));
  const auto pool = std::make_shared<ThreadPool>(0);
  return [=](const LoadBody& body) -> LoadAnswer {
    const auto soup = formats::ReadMesh(BytesOf(body), formats::MeshFormat::kUnknown);
    if (!soup.ok()) return {soup.status(), "", 0, false};
    Uncancelled observer;
    return AnswerOf(pipeline::Fit(*soup, options.fit, *pool, observer));
  };
}

}  // namespace capfit::client
