// One job from admission to result: what the streamed and the unary call have in common.
#ifndef CAPFIT_SERVER_FIT_JOB_H_
#define CAPFIT_SERVER_FIT_JOB_H_

#include <grpcpp/server_context.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "capfit/v1/service.pb.h"
#include "core/base/fit_observer.h"
#include "server/fit_backend.h"
#include "server/fit_executor.h"
#include "server/mesh_upload.h"
#include "server/server_config.h"

namespace capfit::server {

// What all calls share. Must outlive them.
struct CallServices {
  const ServerConfig& config;
  const FitBackend& backend;
  const ThreadPool& pool;
  FitExecutor& executor;
};

// Use: Admit(), then Add() each message in order or AddWhole() the only one, then Run() once, on
// the executor. Cancel() and the questions may come from any thread at any time; header() and
// is_complete() not while another thread is in Add, AddWhole or Run.
class FitJob {
 public:
  // `context` must live as long as the job.
  FitJob(const CallServices& services, grpc::CallbackServerContext& context);

  // RESOURCE_EXHAUSTED when all places are taken.
  [[nodiscard]] absl::Status Admit();
  // Options are judged with the header, before the rest of the upload is waited for.
  [[nodiscard]] absl::Status Add(const v1::ApproximateBodyRequest& request);
  [[nodiscard]] absl::Status AddWhole(const v1::ApproximateBodyUnaryRequest& request);
  [[nodiscard]] bool is_complete() const { return upload_.is_complete(); }

  // Reads the mesh and fits it. Warnings about the request stand before those about the mesh, in a
  // result as in an error. Nothing is thrown.
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> Run(FitObserver& observer);

  // The caller is gone, or what it sends is wrong: the fit stops at its next look.
  void Cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool is_cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  // Also when the deadline has passed.
  [[nodiscard]] bool IsOver() const;
  // CANCELLED or DEADLINE_EXCEEDED.
  [[nodiscard]] absl::Status GaveUp() const;

  [[nodiscard]] const std::string& request_id() const { return upload_.header().request_id(); }

  // The last thing of a call: one log line, and the status for the wire. For RESOURCE_EXHAUSTED the
  // trailer says when to come again.
  [[nodiscard]] grpc::Status Close(const char* method, const absl::Status& status);
  // Gives the place back: before the last reference goes, so that a drained executor finds all.
  void LeavePlace() { place_.reset(); }

 private:
  [[nodiscard]] absl::Status ReadOptions();
  // That formats which need the mesh's own file will have one.
  [[nodiscard]] absl::Status CheckExports() const;
  void NoteUnknownFields(const google::protobuf::Message& request);
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> Compute(FitObserver& observer);
  // An error in the words of the request, with the warnings about it.
  [[nodiscard]] absl::Status InCallersWords(const absl::Status& status) const;

  const CallServices services_;
  grpc::CallbackServerContext& context_;
  const std::chrono::system_clock::time_point deadline_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  FitExecutor::Place place_;
  MeshUpload upload_;
  pipeline::FitOptions options_;
  std::vector<Warning> warnings_;  // about the request
  std::atomic<bool> cancelled_{false};
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FIT_JOB_H_
