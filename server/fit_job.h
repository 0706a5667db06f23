// One job from admission to result: what the streamed and the unary call have in common.
#ifndef CAPFIT_SERVER_FIT_JOB_H_
#define CAPFIT_SERVER_FIT_JOB_H_

#include <grpcpp/server_context.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capfit/v1/service.pb.h"
#include "core/base/fit_observer.h"
#include "server/admission.h"
#include "server/call_record.h"
#include "server/call_services.h"
#include "server/fit_cost.h"
#include "server/mesh_upload.h"

namespace capfit::server {

// Why a job is to stop, as far as its call knows.
enum class StopCause : int {
  kNone,
  kCaller,    // gave up, or is gone
  kReader,    // does not take its answer
  kAnswered,  // the call has an answer already, an error
};

// Use: Admit(), then Add() each message in order or AddWhole() the only one, then Enqueue() a
// function that calls Run() once. Stop() and the questions may come from any thread at any time;
// the rest from one thread at a time.
class FitJob {
 public:
  // `context` must live as long as the job. `token_name`: of the caller's token; "": it has none.
  FitJob(const CallServices& services, grpc::CallbackServerContext& context,
         std::string token_name);

  // RESOURCE_EXHAUSTED when nothing more can be held; INVALID_ARGUMENT for unknown priorities.
  [[nodiscard]] absl::Status Admit();
  // Options are judged with the header, before the rest of the upload is waited for, and so is
  // whether this server has room for what the header claims.
  [[nodiscard]] absl::Status Add(const v1::ApproximateBodyRequest& request);
  // On the executor; Expect must have been called.
  [[nodiscard]] absl::Status AddWhole(const v1::ApproximateBodyUnaryRequest& request);
  // Counts the memory of the request and of what will be made of it; O(1).
  [[nodiscard]] absl::Status Expect(const v1::ApproximateBodyUnaryRequest& request);
  [[nodiscard]] bool is_complete() const { return upload_.is_complete(); }

  // Queues `run` for the executor. RESOURCE_EXHAUSTED when too much waits; `run` is then dropped.
  [[nodiscard]] absl::Status Enqueue(std::function<void()> run);
  // If the job still waits it is taken out of the queue and run here, which stops it at once. To be
  // called after Stop(), without locks that `run` takes.
  void RunNowIfWaiting();
  // Reads the mesh and fits it. Warnings about the request stand before those about the mesh, in a
  // result as in an error. Nothing is thrown.
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> Run(FitObserver& observer);
  // What the answer holds beside its result.
  void HoldAnswer(std::int64_t bytes) { holding_->HoldAnyway(bytes); }

  // The fit stops at its next look. Of several causes the first one counts.
  void Stop(StopCause cause);
  [[nodiscard]] bool is_stopped() const { return cause_.load() != StopCause::kNone; }
  // Also when the caller's deadline, the time for one fit or the grace of a stopping server has
  // passed.
  [[nodiscard]] bool IsOver() const;
  // The error of a call whose job is over: whose doing it was.
  [[nodiscard]] absl::Status GaveUp() const;

  [[nodiscard]] const std::string& request_id() const { return upload_.header().request_id(); }

  // The status for the wire. For RESOURCE_EXHAUSTED the trailer says when to come again.
  [[nodiscard]] grpc::Status Answer(const absl::Status& status);
  // The last thing of a call: one log line, and its metrics.
  void Close(const char* method, const absl::Status& status);
  // Gives back what it holds.
  void Leave() { holding_.reset(); }

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;

  [[nodiscard]] absl::Status ReadOptions();
  // That formats which need the mesh's own file will have one.
  [[nodiscard]] absl::Status CheckExports() const;
  void NoteUnknownFields(const google::protobuf::Message& request);
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> RunGuarded(FitObserver& observer);
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> Compute(FitObserver& observer);
  // Nothing where this result is not known.
  [[nodiscard]] std::optional<pipeline::FitResult> FindKept(const std::string& key);
  // What a result is kept under.
  [[nodiscard]] std::string CacheKey() const;
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> Fit(FitObserver& observer);
  [[nodiscard]] FitSize SizeOfFit() const;
  // An error in the words of the request, with the warnings about it.
  [[nodiscard]] absl::Status InCallersWords(const absl::Status& status) const;

  const CallServices services_;
  grpc::CallbackServerContext& context_;
  const std::string token_name_;  // of the caller's token; "": it has none
  const std::chrono::system_clock::time_point deadline_;
  const SteadyTime begin_ = std::chrono::steady_clock::now();
  std::optional<Holding> holding_;
  MeshUpload upload_;
  std::int64_t request_bytes_ = 0;  // of a unary call's message, which lives as long as the call
  std::int64_t expected_faces_ = 0;
  pipeline::FitOptions options_;
  std::vector<Warning> warnings_;  // about the request
  CallRecord record_;
  SteadyTime queued_at_;
  std::atomic<FitExecutor::Ticket> ticket_{0};
  std::atomic<SteadyTime> fit_deadline_{SteadyTime::max()};
  std::atomic<StopCause> cause_{StopCause::kNone};
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FIT_JOB_H_
