// One ApproximateBody call: the stream's messages in and out. No geometry here.
#ifndef CAPFIT_SERVER_APPROXIMATE_BODY_CALL_H_
#define CAPFIT_SERVER_APPROXIMATE_BODY_CALL_H_

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/server_callback.h>

#include <memory>
#include <mutex>
#include <optional>

#include "server/fit_job.h"
#include "server/response_sequence.h"

namespace capfit::server {

// A stream that is refused before it begins reads its first message before it says so, for no
// longer than this: who never sends one is known by that (reset_guard.h).
inline constexpr double kRefusedReadSeconds = 0.5;

// gRPC's threads run the On...Done callbacks, which only move bytes; the fit runs on the executor,
// with this object as its observer. At most one write is under way, and the next message is made
// when the reader has taken the last; of progress only the latest is kept. An upload that pauses
// and a reader that does not read are ended by the watchdog.
//
// Lives until OnDone and until the job on the executor is over, whichever comes last.
class ApproximateBodyCall final
    : public grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>,
      public FitObserver,
      public std::enable_shared_from_this<ApproximateBodyCall> {
 public:
  // Begins a call; it owns itself. `token_name`: as FitJob.
  static ApproximateBodyCall* Start(grpc::CallbackServerContext* context,
                                    const CallServices& services, const std::string& token_name);

  // For Start only.
  ApproximateBodyCall(grpc::CallbackServerContext* context, const CallServices& services,
                      const std::string& token_name)
      : services_(services), context_(*context), job_(services, *context, token_name) {}

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

  void OnStage(Stage stage, double fraction_done) override;
  [[nodiscard]] bool IsCancelled() const override { return job_.IsOver(); }

 private:
  void Begin();
  void RunJob();
  // All below with mutex_ held.
  void TakeMessage();
  [[nodiscard]] absl::Status AddMessage();
  void SubmitJob();
  // Sends what is next, if nothing is under way.
  void Pump();
  [[nodiscard]] bool NextResponse();
  void End(const absl::Status& status);
  // Whatever rang or is to ring means nothing any more.
  void DropAlarm();
  // Calls `late` after `seconds`, unless the alarm is dropped or set again.
  void SetAlarm(double seconds, void (ApproximateBodyCall::*late)());
  void AwaitMessage();
  void Refuse();
  void UploadIsLate();
  void ReaderIsLate();

  const CallServices services_;
  grpc::CallbackServerContext& context_;  // until OnDone
  FitJob job_;
  std::shared_ptr<ApproximateBodyCall> self_;  // until OnDone

  std::mutex mutex_;
  grpc::ByteBuffer request_bytes_;  // gRPC's while a read is under way
  std::int64_t message_number_ = 0;
  Watchdog::Clock::time_point upload_begin_ = Watchdog::Clock::now();
  Watchdog::Alarm alarm_;
  std::uint64_t alarm_number_ = 0;  // of the last alarm that was set or dropped
  bool is_submitted_ = false;
  bool job_is_running_ = false;
  bool is_writing_ = false;
  bool is_finished_ = false;
  std::optional<v1::Progress> progress_;
  std::optional<ResponseSequence> results_;
  absl::Status refusal_;  // known from the begin, told after the first message
  std::optional<absl::Status> final_status_;
  v1::ApproximateBodyResponse response_;
  grpc::ByteBuffer response_bytes_;  // being written
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_APPROXIMATE_BODY_CALL_H_
