#include "server/approximate_body_call.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <new>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "proto/wire/enum_conversion.h"
#include "proto/wire/options_conversion.h"
#include "proto/wire/result_conversion.h"
#include "proto/wire/status_conversion.h"

namespace capfit::server {

ApproximateBodyCall* ApproximateBodyCall::Start(grpc::CallbackServerContext* context,
                                                const CallServices& services) {
  const auto call = std::make_shared<ApproximateBodyCall>(context, services);
  call->self_ = call;
  call->Begin();
  return call.get();
}

ApproximateBodyCall::ApproximateBodyCall(grpc::CallbackServerContext* context,
                                         const CallServices& services)
    : context_(context),
      services_(services),
      deadline_(context->deadline()),
      begin_(std::chrono::steady_clock::now()),
      upload_(services.config.upload) {}

void ApproximateBodyCall::Begin() {
  place_ = services_.executor.TryTakePlace();
  if (place_ != nullptr) {
    StartRead(&request_);
    return;
  }
  const ServerConfig& config = services_.config;
  context_->AddTrailingMetadata("grpc-retry-pushback-ms", std::to_string(config.retry_pushback_ms));
  End(absl::ResourceExhaustedError(
      absl::StrCat("all ", config.max_concurrent_fits + config.max_queued_fits,
                   " places of this server are taken, try again in ", config.retry_pushback_ms,
                   " ms or ask another replica")));
}

void ApproximateBodyCall::OnReadDone(bool ok) {
  if (!ok) {
    SubmitJob();
    return;
  }
  const absl::Status status = AddRequest();
  if (status.ok()) {
    StartRead(&request_);
  } else {
    End(status);
  }
}

absl::Status ApproximateBodyCall::AddRequest() {
  const bool is_first = !upload_.has_header();
  CAPFIT_RETURN_IF_ERROR(upload_.Add(request_));
  if (!is_first) return absl::OkStatus();
  // Options are judged before the rest of the upload is waited for.
  CAPFIT_ASSIGN_OR_RETURN(options_, wire::OptionsFromWire(upload_.header()));
  return services_.backend.validate(options_);
}

void ApproximateBodyCall::SubmitJob() {
  {
    const std::lock_guard lock(mutex_);
    job_is_running_ = true;
  }
  request_.Clear();
  services_.executor.Submit([self = shared_from_this()] { self->RunJob(); });
}

void ApproximateBodyCall::RunJob() {
  absl::StatusOr<pipeline::FitResult> result = ComputeGuarded();
  const std::lock_guard lock(mutex_);
  job_is_running_ = false;
  if (result.ok()) {
    results_.emplace(*std::move(result), upload_.header().request_id());
  } else {
    final_status_ = result.status();
  }
  Pump();
}

// The core throws nothing of its own; the libraries under it may, above all for want of memory.
// That must cost one call, not the server.
absl::StatusOr<pipeline::FitResult> ApproximateBodyCall::ComputeGuarded() {
  try {
    return Compute();
  } catch (const std::bad_alloc&) {
    return absl::ResourceExhaustedError("not enough memory for this mesh on this server");
  } catch (const std::exception& error) {
    return absl::InternalError(absl::StrCat("the fit failed: ", error.what()));
  }
}

absl::StatusOr<pipeline::FitResult> ApproximateBodyCall::Compute() {
  // A read that ends because the caller is gone looks like the end of the upload; only the context
  // knows already.
  if (IsCancelled() || context_->IsCancelled()) return GaveUp();
  CAPFIT_ASSIGN_OR_RETURN(const mesh::PolygonSoup soup, std::move(upload_).Finish());
  absl::StatusOr<pipeline::FitResult> result =
      services_.backend.fit(soup, options_, services_.pool, *this);
  if (absl::IsCancelled(result.status())) return GaveUp();
  return result;
}

absl::Status ApproximateBodyCall::GaveUp() const {
  if (std::chrono::system_clock::now() >= deadline_) {
    return absl::DeadlineExceededError("the caller's deadline passed during the fit");
  }
  return absl::CancelledError("the caller gave up");
}

void ApproximateBodyCall::OnStage(Stage stage, double fraction_done) {
  v1::Progress progress;
  progress.set_stage(wire::ToWire(stage));
  progress.set_fraction_done(fraction_done);
  const std::lock_guard lock(mutex_);
  progress_ = std::move(progress);
  Pump();
}

bool ApproximateBodyCall::IsCancelled() const {
  return cancelled_.load(std::memory_order_relaxed) ||
         std::chrono::system_clock::now() >= deadline_;
}

void ApproximateBodyCall::OnCancel() { cancelled_.store(true, std::memory_order_relaxed); }

void ApproximateBodyCall::OnWriteDone(bool ok) {
  const std::lock_guard lock(mutex_);
  is_writing_ = false;
  if (!ok) {
    // Nobody reads any more. The job, if it still runs, sees this and ends the call.
    cancelled_.store(true, std::memory_order_relaxed);
    results_.reset();
    progress_.reset();
    if (!final_status_) final_status_ = absl::CancelledError("the caller stopped reading");
  }
  Pump();
}

void ApproximateBodyCall::Pump() {
  if (is_writing_ || is_finished_) return;
  if (!cancelled_.load(std::memory_order_relaxed) && NextResponse()) {
    is_writing_ = true;
    StartWrite(&response_);
    return;
  }
  if (job_is_running_) return;
  if (final_status_) {
    FinishWith(*final_status_);
  } else if (results_) {
    FinishWith(cancelled_.load(std::memory_order_relaxed) ? GaveUp() : absl::OkStatus());
  }
}

bool ApproximateBodyCall::NextResponse() {
  if (progress_) {
    response_.Clear();
    *response_.mutable_progress() = *std::exchange(progress_, std::nullopt);
    return true;
  }
  return results_ && results_->Next(response_);
}

void ApproximateBodyCall::FinishWith(const absl::Status& status) {
  is_finished_ = true;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  spdlog::info("ApproximateBody id={} peer={} bytes={} seconds={:.3f} status={}",
               wire::PlainText(upload_.header().request_id()), context_->peer(),
               upload_.received_bytes(), seconds,
               status.ok() ? "OK" : wire::PlainText(status.ToString()));
  Finish(wire::ToGrpcStatus(status));
}

void ApproximateBodyCall::End(const absl::Status& status) {
  const std::lock_guard lock(mutex_);
  final_status_ = status;
  Pump();
}

void ApproximateBodyCall::OnDone() {
  // The place goes back before the last reference, so that a drained executor finds all of them.
  place_.reset();
  const std::shared_ptr<ApproximateBodyCall> last = std::move(self_);
}

}  // namespace capfit::server
