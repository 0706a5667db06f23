#include "server/approximate_body_call.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "proto/wire/enum_conversion.h"
#include "server/raw_message.h"

namespace capfit::server {

ApproximateBodyCall* ApproximateBodyCall::Start(grpc::CallbackServerContext* context,
                                                const CallServices& services,
                                                const std::string& token_name) {
  const auto call = std::make_shared<ApproximateBodyCall>(context, services, token_name);
  call->self_ = call;
  call->Begin();
  return call.get();
}

void ApproximateBodyCall::Begin() {
  const std::lock_guard lock(mutex_);
  refusal_ = job_.Admit();
  if (refusal_.ok()) {
    AwaitMessage();
  } else {
    SetAlarm(kRefusedReadSeconds, &ApproximateBodyCall::Refuse);
  }
  StartRead(&request_bytes_);
}

void ApproximateBodyCall::OnReadDone(bool ok) {
  {
    const std::lock_guard lock(mutex_);
    if (final_status_) return;  // the watchdog was quicker
    if (!refusal_.ok()) return Refuse();
    if (ok) {
      TakeMessage();
    } else if (!is_submitted_) {
      SubmitJob();
    }
  }
  // Also when it was stopped between the last message and its place in the queue.
  if (job_.is_stopped()) job_.RunNowIfWaiting();
}

void ApproximateBodyCall::TakeMessage() {
  if (is_submitted_) {  // the upload belongs to the job by now
    return End(InvalidField(ErrorReason::kCountMismatch, "chunk",
                            "came after all that the header declares had arrived"));
  }
  const absl::Status status = AddMessage();
  if (!status.ok()) return End(status);
  if (job_.is_complete()) {
    SubmitJob();
    if (final_status_) return;
  } else {
    AwaitMessage();
  }
  // Also after that: the end of the upload, or a message too many.
  StartRead(&request_bytes_);
}

absl::Status ApproximateBodyCall::AddMessage() {
  v1::ApproximateBodyRequest request;
  CAPFIT_RETURN_IF_ERROR(Decode(
      request_bytes_, absl::StrCat("message ", ++message_number_, " of the upload"), request));
  return job_.Add(request);
}

void ApproximateBodyCall::SubmitJob() {
  DropAlarm();
  is_submitted_ = true;
  request_bytes_.Clear();
  job_is_running_ = true;
  const absl::Status status = job_.Enqueue([self = shared_from_this()] { self->RunJob(); });
  if (status.ok()) return;
  job_is_running_ = false;
  End(status);
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
  DropAlarm();
  if (!ok) {
    // Nobody reads any more. The job, if it still runs, sees this and ends the call.
    job_.Stop(StopCause::kCaller);
    results_.reset();
    progress_.reset();
    if (!final_status_) final_status_ = job_.GaveUp();
  }
  Pump();
}

void ApproximateBodyCall::Pump() {
  if (is_writing_ || is_finished_) return;
  if (!job_.is_stopped() && NextResponse()) {
    is_writing_ = true;
    SetAlarm(services_.config.read_idle_seconds, &ApproximateBodyCall::ReaderIsLate);
    StartWrite(&response_bytes_);
    return;
  }
  if (job_is_running_ || (!final_status_ && !results_)) return;
  is_finished_ = true;
  const absl::Status over = job_.is_stopped() ? job_.GaveUp() : absl::OkStatus();
  const absl::Status status = final_status_.value_or(over);
  job_.Close("ApproximateBody", status);
  Finish(job_.Answer(status));
}

bool ApproximateBodyCall::NextResponse() {
  if (progress_) {
    response_.Clear();
    *response_.mutable_progress() = *std::exchange(progress_, std::nullopt);
  } else if (!results_ || !results_->Next(response_)) {
    return false;
  }
  const absl::Status status = Encode(response_, response_bytes_);
  if (!status.ok()) final_status_ = status;
  return status.ok();
}

void ApproximateBodyCall::End(const absl::Status& status) {
  DropAlarm();
  final_status_ = status;
  job_.Stop(StopCause::kAnswered);
  results_.reset();
  Pump();
}

void ApproximateBodyCall::DropAlarm() {
  services_.watchdog.Drop(alarm_);
  ++alarm_number_;
}

void ApproximateBodyCall::SetAlarm(double seconds, void (ApproximateBodyCall::*late)()) {
  DropAlarm();
  const auto ring = [weak = weak_from_this(), number = alarm_number_, late] {
    const std::shared_ptr<ApproximateBodyCall> call = weak.lock();
    if (call == nullptr) return;
    const std::lock_guard lock(call->mutex_);
    if (number == call->alarm_number_) (call.get()->*late)();
  };
  alarm_ = services_.watchdog.Set(Watchdog::After(seconds), ring);
}

void ApproximateBodyCall::AwaitMessage() {
  const double left = services_.config.max_upload_seconds - Watchdog::SecondsSince(upload_begin_);
  SetAlarm(std::min(services_.config.upload_idle_seconds, left),
           &ApproximateBodyCall::UploadIsLate);
}

void ApproximateBodyCall::Refuse() { End(refusal_); }

void ApproximateBodyCall::UploadIsLate() {
  const ServerConfig& config = services_.config;
  const bool is_over = Watchdog::SecondsSince(upload_begin_) >= config.max_upload_seconds;
  End(Refused(ErrorReason::kUploadTooSlow,
              is_over
                  ? absl::StrCat("the upload did not end within ", config.max_upload_seconds, " s")
                  : absl::StrCat("nothing more of the upload came for ", config.upload_idle_seconds,
                                 " s")));
}

// What is being written stays with gRPC until the call is cut, so no status can be sent any more.
void ApproximateBodyCall::ReaderIsLate() {
  job_.Stop(StopCause::kReader);
  context_.TryCancel();
}

void ApproximateBodyCall::OnCancel() {
  job_.Stop(StopCause::kCaller);
  job_.RunNowIfWaiting();
}

void ApproximateBodyCall::OnDone() {
  {
    const std::lock_guard lock(mutex_);
    DropAlarm();
    results_.reset();
  }
  job_.Leave();
  const std::shared_ptr<ApproximateBodyCall> last = std::move(self_);
}

}  // namespace capfit::server
