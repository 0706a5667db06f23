#include "server/service.h"

#include "proto/wire/status_conversion.h"
#include "server/approximate_body_call.h"
#include "server/approximate_body_unary_call.h"

namespace capfit::server {
namespace {

using BodyStream = grpc::ServerBidiReactor<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>;

// Ends before it begins.
class RefusedStream final : public BodyStream {
 public:
  explicit RefusedStream(const absl::Status& status) { Finish(wire::ToGrpcStatus(status)); }
  void OnDone() override { delete this; }
};

grpc::ServerUnaryReactor* Finished(grpc::CallbackServerContext& context,
                                   const absl::Status& status) {
  grpc::ServerUnaryReactor* const reactor = context.DefaultReactor();
  reactor->Finish(wire::ToGrpcStatus(status));
  return reactor;
}

}  // namespace

absl::StatusOr<std::string> Service::CallerOf(const char* method,
                                              const grpc::CallbackServerContext& context) {
  absl::StatusOr<std::string> caller = callers_.NameOf(context);
  if (!caller.ok()) services_.metrics.Count(method, caller.status());
  return caller;
}

BodyStream* Service::ApproximateBody(grpc::CallbackServerContext* context) {
  const absl::StatusOr<std::string> caller = CallerOf("ApproximateBody", *context);
  if (!caller.ok()) return new RefusedStream(caller.status());
  return ApproximateBodyCall::Start(context, services_, *caller);
}

grpc::ServerUnaryReactor* Service::ApproximateBodyUnary(
    grpc::CallbackServerContext* context, const v1::ApproximateBodyUnaryRequest* request,
    v1::ApproximateBodyUnaryResponse* response) {
  const absl::StatusOr<std::string> caller = CallerOf("ApproximateBodyUnary", *context);
  if (!caller.ok()) return Finished(*context, caller.status());
  return ApproximateBodyUnaryCall::Start(context, request, response, services_, *caller);
}

grpc::ServerUnaryReactor* Service::GetServerInfo(grpc::CallbackServerContext* context,
                                                 const v1::GetServerInfoRequest* /*request*/,
                                                 v1::GetServerInfoResponse* response) {
  const absl::StatusOr<std::string> caller = CallerOf("GetServerInfo", *context);
  if (!caller.ok()) return Finished(*context, caller.status());
  *response = info_;
  services_.metrics.Count("GetServerInfo", absl::OkStatus());
  return Finished(*context, absl::OkStatus());
}

}  // namespace capfit::server
