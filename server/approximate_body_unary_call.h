// One ApproximateBodyUnary call. No geometry here.
#ifndef CAPFIT_SERVER_APPROXIMATE_BODY_UNARY_CALL_H_
#define CAPFIT_SERVER_APPROXIMATE_BODY_UNARY_CALL_H_

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <memory>
#include <mutex>

#include "server/fit_job.h"

namespace capfit::server {

// The request is read and the fit runs on the executor. Lives until OnDone and until the job is
// over, whichever comes last.
class ApproximateBodyUnaryCall final
    : public grpc::ServerUnaryReactor,
      public FitObserver,
      public std::enable_shared_from_this<ApproximateBodyUnaryCall> {
 public:
  // Begins a call; it owns itself. Request and response live until it is finished; the request's
  // bytes are let go of once they are read.
  static ApproximateBodyUnaryCall* Start(grpc::CallbackServerContext* context,
                                         grpc::ByteBuffer& request, grpc::ByteBuffer& response,
                                         const CallServices& services,
                                         const std::string& token_name);

  // For Start only.
  ApproximateBodyUnaryCall(grpc::CallbackServerContext* context, grpc::ByteBuffer& response,
                           const CallServices& services, const std::string& token_name)
      : services_(services),
        context_(*context),
        job_(services, *context, token_name),
        response_(response) {}

  void OnCancel() override;
  void OnDone() override;

  void OnStage(Stage, double) override {}
  [[nodiscard]] bool IsCancelled() const override { return job_.IsOver(); }

 private:
  void Begin(grpc::ByteBuffer& request);
  [[nodiscard]] absl::Status Submit(grpc::ByteBuffer& request);
  [[nodiscard]] absl::Status RunJob();
  void End(const absl::Status& status);
  void ReaderIsLate();

  const CallServices services_;
  grpc::CallbackServerContext& context_;  // until OnDone
  FitJob job_;
  v1::ApproximateBodyUnaryRequest request_;
  grpc::ByteBuffer& response_;
  std::shared_ptr<ApproximateBodyUnaryCall> self_;  // until OnDone
  std::mutex mutex_;
  Watchdog::Alarm alarm_;
  absl::Status answered_;
  bool is_late_ = false;
  bool is_done_ = false;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_APPROXIMATE_BODY_UNARY_CALL_H_
