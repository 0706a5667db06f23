#include "server/service.h"

#include <atomic>
#include <memory>
#include <utility>

#include "proto/wire/status_conversion.h"
#include "server/approximate_body_call.h"
#include "server/approximate_body_unary_call.h"
#include "server/raw_message.h"
#include "server/watchdog.h"

namespace capfit::server {
namespace {

using BodyStream = grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>;

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
  grpc::ByteBuffer request_;
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

grpc::ServerUnaryReactor* Service::ApproximateBodyUnary(grpc::CallbackServerContext* context,
                                                        const grpc::ByteBuffer* request,
                                                        grpc::ByteBuffer* response) {
  const absl::StatusOr<std::string> caller = CallerOf("ApproximateBodyUnary", *context);
  if (!caller.ok()) return Finished(*context, caller.status());
  // The request is this call's own; gRPC would keep its bytes beside the message until the end.
  auto& bytes = const_cast<grpc::ByteBuffer&>(*request);
  return ApproximateBodyUnaryCall::Start(context, bytes, *response, services_, *caller);
}

grpc::ServerUnaryReactor* Service::GetServerInfo(grpc::CallbackServerContext* context,
                                                 const grpc::ByteBuffer* request,
                                                 grpc::ByteBuffer* response) {
  const absl::StatusOr<std::string> caller = CallerOf("GetServerInfo", *context);
  if (!caller.ok()) return Finished(*context, caller.status());
  grpc::ByteBuffer bytes = *request;
  v1::GetServerInfoRequest asked;
  absl::Status status = Decode(bytes, "the request", asked);
  if (status.ok()) status = Encode(info_, *response);
  services_.metrics.Count("GetServerInfo", status);
  return Finished(*context, status);
}

}  // namespace capfit::server
