#include "server/service.h"

#include <atomic>
#include <memory>
#include <utility>

#include "proto/wire/status_conversion.h"
#include "server/approximate_body_call.h"
#include "server/approximate_body_unary_call.h"
#include "server/watchdog.h"

namespace capfit::server {
namespace {

using BodyStream = grpc::ServerBidiReactor<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>;

// Ends after its first message, or soon without one.
class RefusedStream final : public BodyStream, public std::enable_shared_from_this<RefusedStream> {
 public:
  static RefusedStream* Start(const absl::Status& status, Watchdog& watchdog) {
    const auto stream = std::make_shared<RefusedStream>(status);
    stream->self_ = stream;
    watchdog.Set(Watchdog::After(kRefusedReadSeconds), [weak = std::weak_ptr(stream)] {
      if (const std::shared_ptr<RefusedStream> lives = weak.lock()) lives->Refuse();
    });
    stream->StartRead(&stream->request_);
    return stream.get();
  }

  // For Start only.
  explicit RefusedStream(const absl::Status& status) : status_(wire::ToGrpcStatus(status)) {}

  void OnReadDone(bool /*ok*/) override { Refuse(); }
  void OnDone() override { const std::shared_ptr<RefusedStream> last = std::move(self_); }

 private:
  void Refuse() {
    if (!is_finished_.exchange(true)) Finish(status_);
  }

  const grpc::Status status_;
  std::atomic<bool> is_finished_{false};
  v1::ApproximateBodyRequest request_;
  std::shared_ptr<RefusedStream> self_;  // until OnDone
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
  if (!caller.ok()) return RefusedStream::Start(caller.status(), services_.watchdog);
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
