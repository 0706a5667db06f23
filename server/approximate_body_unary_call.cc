#include "server/approximate_body_unary_call.h"

#include <utility>

#include "core/base/status.h"
#include "proto/wire/result_conversion.h"

namespace capfit::server {

ApproximateBodyUnaryCall* ApproximateBodyUnaryCall::Start(
    grpc::CallbackServerContext* context, const v1::ApproximateBodyUnaryRequest* request,
    v1::ApproximateBodyUnaryResponse* response, const CallServices& services) {
  const auto call =
      std::make_shared<ApproximateBodyUnaryCall>(context, request, response, services);
  call->self_ = call;
  call->Begin();
  return call.get();
}

void ApproximateBodyUnaryCall::Begin() {
  const absl::Status status = job_.Admit();
  if (!status.ok()) {
    End(status);
    return;
  }
  services_.executor.Submit([self = shared_from_this()] { self->End(self->RunJob()); });
}

absl::Status ApproximateBodyUnaryCall::RunJob() {
  CAPFIT_RETURN_IF_ERROR(job_.AddWhole(request_));
  CAPFIT_ASSIGN_OR_RETURN(const pipeline::FitResult result, job_.Run(*this));
  response_ = wire::ResultToWire(result, job_.request_id());
  return job_.is_cancelled() ? job_.GaveUp() : absl::OkStatus();
}

void ApproximateBodyUnaryCall::End(const absl::Status& status) {
  Finish(job_.Close("ApproximateBodyUnary", status));
}

void ApproximateBodyUnaryCall::OnDone() {
  job_.LeavePlace();
  const std::shared_ptr<ApproximateBodyUnaryCall> last = std::move(self_);
}

}  // namespace capfit::server
