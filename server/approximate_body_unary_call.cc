#include "server/approximate_body_unary_call.h"

#include <utility>

#include "core/base/status.h"
#include "proto/wire/result_conversion.h"
#include "server/raw_message.h"

namespace capfit::server {

ApproximateBodyUnaryCall* ApproximateBodyUnaryCall::Start(grpc::CallbackServerContext* context,
                                                          grpc::ByteBuffer& request,
                                                          grpc::ByteBuffer& response,
                                                          const CallServices& services,
                                                          const std::string& token_name) {
  const auto call =
      std::make_shared<ApproximateBodyUnaryCall>(context, response, services, token_name);
  call->self_ = call;
  call->Begin(request);
  return call.get();
}

void ApproximateBodyUnaryCall::Begin(grpc::ByteBuffer& request) {
  const absl::Status status = Submit(request);
  if (!status.ok()) End(status);
  if (job_.is_stopped()) job_.RunNowIfWaiting();
}

absl::Status ApproximateBodyUnaryCall::Submit(grpc::ByteBuffer& request) {
  CAPFIT_RETURN_IF_ERROR(job_.Admit());
  CAPFIT_RETURN_IF_ERROR(Decode(request, "the request", request_));
  CAPFIT_RETURN_IF_ERROR(job_.Expect(request_));
  return job_.Enqueue([self = shared_from_this()] { self->End(self->RunJob()); });
}

absl::Status ApproximateBodyUnaryCall::RunJob() {
  CAPFIT_RETURN_IF_ERROR(job_.AddWhole(request_));
  CAPFIT_ASSIGN_OR_RETURN(const pipeline::FitResult result, job_.Run(*this));
  CAPFIT_RETURN_IF_ERROR(Encode(wire::ResultToWire(result, job_.request_id()), response_));
  job_.HoldAnswer(static_cast<std::int64_t>(request_.ByteSizeLong() + response_.Length()));
  return job_.is_stopped() ? job_.GaveUp() : absl::OkStatus();
}

void ApproximateBodyUnaryCall::End(const absl::Status& status) {
  const grpc::Status answer = job_.Answer(status);
  const std::lock_guard lock(mutex_);
  answered_ = status;
  const auto ring = [weak = weak_from_this()] {
    if (const std::shared_ptr<ApproximateBodyUnaryCall> call = weak.lock()) call->ReaderIsLate();
  };
  alarm_ = services_.watchdog.Set(Watchdog::After(services_.config.read_idle_seconds), ring);
  Finish(answer);
}

void ApproximateBodyUnaryCall::ReaderIsLate() {
  const std::lock_guard lock(mutex_);
  if (is_done_) return;
  is_late_ = true;
  job_.Stop(StopCause::kReader);
  context_.TryCancel();
}

void ApproximateBodyUnaryCall::OnCancel() {
  job_.Stop(StopCause::kCaller);
  job_.RunNowIfWaiting();
}

void ApproximateBodyUnaryCall::OnDone() {
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
    services_.watchdog.Drop(alarm_);
  }
  // Not before: only now is it known whether the answer was taken.
  job_.Close("ApproximateBodyUnary", is_late_ && answered_.ok() ? job_.GaveUp() : answered_);
  job_.Leave();
  const std::shared_ptr<ApproximateBodyUnaryCall> last = std::move(self_);
}

}  // namespace capfit::server
