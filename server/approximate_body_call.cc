#include "server/approximate_body_call.h"

#include <utility>

#include "core/base/status.h"
#include "proto/wire/enum_conversion.h"

namespace capfit::server {

ApproximateBodyCall* ApproximateBodyCall::Start(grpc::CallbackServerContext* context,
                                                const CallServices& services) {
  const auto call = std::make_shared<ApproximateBodyCall>(context, services);
  call->self_ = call;
  call->Begin();
  return call.get();
}

void ApproximateBodyCall::Begin() {
  const absl::Status status = job_.Admit();
  if (status.ok()) {
    StartRead(&request_);
  } else {
    End(status);
  }
}

void ApproximateBodyCall::OnReadDone(bool ok) {
  if (!ok) {
    if (!is_submitted_) SubmitJob();
    return;
  }
  if (is_submitted_) {  // the upload belongs to the job by now
    End(InvalidField(ErrorReason::kCountMismatch, "chunk",
                     "came after all that the header declares had arrived"));
    return;
  }
  const absl::Status status = job_.Add(request_);
  if (!status.ok()) {
    End(status);
    return;
  }
  if (job_.is_complete()) SubmitJob();
  // Also after that: the end of the upload, or a message too many.
  StartRead(&request_);
}

void ApproximateBodyCall::SubmitJob() {
  is_submitted_ = true;
  {
    const std::lock_guard lock(mutex_);
    job_is_running_ = true;
  }
  request_.Clear();
  services_.executor.Submit([self = shared_from_this()] { self->RunJob(); });
}

void ApproximateBodyCall::RunJob() {
  absl::StatusOr<pipeline::FitResult> result = job_.Run(*this);
  const std::lock_guard lock(mutex_);
  job_is_running_ = false;
  if (final_status_) {
    // A message too many, or nobody reads: that is the answer.
  } else if (result.ok()) {
    results_.emplace(*std::move(result), job_.request_id());
  } else {
    final_status_ = result.status();
  }
  Pump();
}

void ApproximateBodyCall::OnStage(Stage stage, double fraction_done) {
  v1::Progress progress;
  progress.set_stage(wire::ToWire(stage));
  progress.set_fraction_done(fraction_done);
  const std::lock_guard lock(mutex_);
  progress_ = std::move(progress);
  Pump();
}

void ApproximateBodyCall::OnWriteDone(bool ok) {
  const std::lock_guard lock(mutex_);
  is_writing_ = false;
  if (!ok) {
    // Nobody reads any more. The job, if it still runs, sees this and ends the call.
    job_.Cancel();
    results_.reset();
    progress_.reset();
    if (!final_status_) {
      final_status_ = Refused(ErrorReason::kCancelled, "the caller stopped reading");
    }
  }
  Pump();
}

void ApproximateBodyCall::Pump() {
  if (is_writing_ || is_finished_) return;
  if (!job_.is_cancelled() && NextResponse()) {
    is_writing_ = true;
    StartWrite(&response_);
    return;
  }
  if (job_is_running_ || (!final_status_ && !results_)) return;
  is_finished_ = true;
  const absl::Status over = job_.is_cancelled() ? job_.GaveUp() : absl::OkStatus();
  Finish(job_.Close("ApproximateBody", final_status_.value_or(over)));
}

bool ApproximateBodyCall::NextResponse() {
  if (progress_) {
    response_.Clear();
    *response_.mutable_progress() = *std::exchange(progress_, std::nullopt);
    return true;
  }
  return results_ && results_->Next(response_);
}

void ApproximateBodyCall::End(const absl::Status& status) {
  const std::lock_guard lock(mutex_);
  final_status_ = status;
  job_.Cancel();
  results_.reset();
  Pump();
}

void ApproximateBodyCall::OnDone() {
  job_.LeavePlace();
  const std::shared_ptr<ApproximateBodyCall> last = std::move(self_);
}

}  // namespace capfit::server
