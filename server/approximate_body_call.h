// One ApproximateBody call: reads the upload, hands it to the executor, writes what comes of it.
#ifndef CAPFIT_SERVER_APPROXIMATE_BODY_CALL_H_
#define CAPFIT_SERVER_APPROXIMATE_BODY_CALL_H_

#include <grpcpp/server_context.h>
#include <grpcpp/support/server_callback.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "capfit/v1/service.pb.h"
#include "core/base/fit_observer.h"
#include "server/fit_backend.h"
#include "server/fit_executor.h"
#include "server/mesh_upload.h"
#include "server/response_sequence.h"
#include "server/server_config.h"

namespace capfit::server {

// What all calls share. Must outlive them.
struct CallServices {
  const ServerConfig& config;
  const FitBackend& backend;
  const ThreadPool& pool;
  FitExecutor& executor;
};

// gRPC's threads run the On...Done callbacks, which only move bytes; the fit runs on the executor,
// with this object as its observer. At most one write is under way, and the next message is made
// when the reader has taken the last; of progress only the latest is kept.
//
// Lives until OnDone and until the job on the executor is over, whichever comes last.
class ApproximateBodyCall final
    : public grpc::ServerBidiReactor<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>,
      public FitObserver,
      public std::enable_shared_from_this<ApproximateBodyCall> {
 public:
  // Begins a call; it owns itself.
  static ApproximateBodyCall* Start(grpc::CallbackServerContext* context,
                                    const CallServices& services);

  // For Start only.
  ApproximateBodyCall(grpc::CallbackServerContext* context, const CallServices& services);

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

  void OnStage(Stage stage, double fraction_done) override;
  [[nodiscard]] bool IsCancelled() const override;

 private:
  void Begin();
  [[nodiscard]] absl::Status AddRequest();
  void SubmitJob();
  void RunJob();
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> Compute();
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> ComputeGuarded();
  [[nodiscard]] absl::Status GaveUp() const;
  // Sends what is next, if nothing is under way. With mutex_ held, as the two below.
  void Pump();
  [[nodiscard]] bool NextResponse();
  void FinishWith(const absl::Status& status);
  void End(const absl::Status& status);

  grpc::CallbackServerContext* const context_;
  const CallServices services_;
  const std::chrono::system_clock::time_point deadline_;
  const std::chrono::steady_clock::time_point begin_;
  FitExecutor::Place place_;
  std::shared_ptr<ApproximateBodyCall> self_;  // until OnDone

  // The upload: touched by OnReadDone, then by the job.
  v1::ApproximateBodyRequest request_;
  MeshUpload upload_;
  pipeline::FitOptions options_;

  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  bool job_is_running_ = false;
  bool is_writing_ = false;
  bool is_finished_ = false;
  std::optional<v1::Progress> progress_;
  std::optional<ResponseSequence> results_;
  std::optional<absl::Status> final_status_;
  v1::ApproximateBodyResponse response_;  // the one being written
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_APPROXIMATE_BODY_CALL_H_
