// What clients can do to a server and to each other with uploads that stop, answers that nobody
// reads and claims that lie: over real connections, with short times.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "proto/wire/status_conversion.h"
#include "tests/server/fake_fit.h"
#include "tests/server/raw_connection.h"
#include "tests/server/service_call.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

ServerConfig ShortTimes() {
  ServerConfig config;
  config.upload_idle_seconds = 0.5;
  config.read_idle_seconds = 0.5;
  return config;
}

absl::Status EndOf(Call& call) { return wire::FromGrpcStatus(call.Finish()); }

bool IsServed(const Server& server) {
  Call call(LoopbackChannel(server));
  call.Send({Header(), Chunk()});
  const grpc::Status status = call.Finish();
  EXPECT_TRUE(status.ok()) << status.error_message();
  return status.ok();
}

TEST(Limits, TwoHundredIdleUploadsKeepNobodyOutAndAreEnded) {
  ServerConfig config = ShortTimes();
  config.max_concurrent_fits = 2;
  config.max_queued_fits = 16;
  config.max_held_bytes = 64 * 1024 * 1024;
  config.upload_idle_seconds = 3.0;
  const auto server = StartServer(InstantBackend(), config);
  std::vector<std::unique_ptr<Call>> idle;
  for (int i = 0; i < 200; ++i) {
    idle.push_back(std::make_unique<Call>(LoopbackChannel(*server)));
    idle.back()->stream->Write(Header());
  }
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(IsServed(*server));
  for (const std::unique_ptr<Call>& call : idle) {
    const absl::Status status = EndOf(*call);
    EXPECT_EQ(status.code(), absl::StatusCode::kDeadlineExceeded);
    EXPECT_EQ(ReasonOf(status), ErrorReason::kUploadTooSlow);
    EXPECT_THAT(std::string(status.message()),
                HasSubstr("nothing more of the upload came for 3 s"));
  }
  EXPECT_TRUE(WaitFor([&] { return server->held_bytes() == 0; }));
}

TEST(Limits, AnUploadThatOnlyTricklesIsEndedToo) {
  ServerConfig config = ShortTimes();
  config.max_upload_seconds = 1.0;
  const auto server = StartServer(InstantBackend(), config);
  Call call(LoopbackChannel(*server));
  call.stream->Write(Header());
  while (call.stream->Write(Positions(1))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const absl::Status status = EndOf(call);
  EXPECT_EQ(ReasonOf(status), ErrorReason::kUploadTooSlow);
  EXPECT_THAT(std::string(status.message()), HasSubstr("did not end within 1 s"));
}

TEST(Limits, AClaimTakesNothingUntilItComesTrue) {
  ServerConfig config = ShortTimes();
  config.upload_idle_seconds = 20.0;
  const auto server = StartServer(InstantBackend(), config);
  std::vector<std::unique_ptr<Call>> liars;
  for (int i = 0; i < 30; ++i) {
    liars.push_back(std::make_unique<Call>(LoopbackChannel(*server)));
    v1::ApproximateBodyRequest header;
    header.mutable_header()->mutable_mesh()->mutable_file()->set_byte_count(128LL * 1024 * 1024);
    liars.back()->stream->Write(header);
  }
  ASSERT_TRUE(WaitFor([&] { return server->held_bytes() >= 30 * kBytesOfACall; }));
  EXPECT_LT(server->held_bytes(), 31 * kBytesOfACall);
  EXPECT_TRUE(IsServed(*server));
  for (const std::unique_ptr<Call>& call : liars) call->context.TryCancel();
}

TEST(Limits, UploadsBeyondTheBudgetAreToldToComeAgain) {
  ServerConfig config = ShortTimes();
  config.max_held_bytes = 16 * 1024 * 1024;
  config.upload_idle_seconds = 20.0;
  config.client_percent = 100;
  const auto server = StartServer(InstantBackend(), config);
  std::vector<std::unique_ptr<Call>> uploads;
  int refused = 0;
  for (int i = 0; i < 10; ++i) {
    uploads.push_back(std::make_unique<Call>(LoopbackChannel(*server)));
    Call& call = *uploads.back();
    call.stream->Write(Header());
    // Two messages of 1.2 MB, held as doubles: 4.8 MB.
    call.stream->Write(Positions(100'000));
    call.stream->Write(Positions(100'000));
  }
  // Some of them are refused, as soon as their bytes come; the others stay.
  EXPECT_TRUE(WaitFor([&] { return server->held_bytes() > 4'000'000; }));
  for (const std::unique_ptr<Call>& call : uploads) {
    EXPECT_LE(server->held_bytes(), config.max_held_bytes);
    call->stream->WritesDone();
    const absl::Status status = EndOf(*call);
    if (absl::IsResourceExhausted(status)) {
      ++refused;
      EXPECT_GE(std::atoi(call->Trailer("grpc-retry-pushback-ms").c_str()), 500);
    } else {
      EXPECT_TRUE(status.ok()) << status;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 10);
  EXPECT_TRUE(IsServed(*server));
}

TEST(Limits, WhatNeverFitsIsTheCallersMistake) {
  ServerConfig config = ShortTimes();
  config.max_held_bytes = 16 * 1024 * 1024;
  const auto server = StartServer(InstantBackend(), config);
  Call call(LoopbackChannel(*server));
  call.stream->Write(Header());
  while (call.stream->Write(Positions(100'000))) {
  }
  const absl::Status status = EndOf(call);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(ReasonOf(status), ErrorReason::kTooLarge);
}

TEST(Limits, ReadersThatDoNotReadAreCutOffAndFreeWhatTheyHold) {
  const auto server = StartServer(InstantBackend(1'000'000), ShortTimes());  // 12 MB of weights
  std::vector<std::unique_ptr<Call>> stalled;
  for (int i = 0; i < 20; ++i) {
    stalled.push_back(std::make_unique<Call>(LoopbackChannel(*server)));
    stalled.back()->Send({Header(), Chunk()});
  }
  EXPECT_TRUE(WaitFor([&] { return server->held_bytes() > 100'000'000; }));
  EXPECT_TRUE(WaitFor([&] { return server->held_bytes() == 0; }));
  for (const std::unique_ptr<Call>& call : stalled) EXPECT_FALSE(call->Finish().ok());
  EXPECT_TRUE(IsServed(*server));
}

// One message as gRPC frames it: not packed, and its length in four bytes.
std::string Framed(const std::string& message) {
  std::string frame(1, '\0');
  for (int shift = 24; shift >= 0; shift -= 8) {
    frame += static_cast<char>(message.size() >> shift & 0xff);
  }
  return frame + message;
}

TEST(Limits, AUnaryReaderThatDoesNotReadIsCutOffAndRecordedSo) {
  const auto server = StartServer(InstantBackend(200'000), ShortTimes());  // 800 KB of gaps
  v1::ApproximateBodyUnaryRequest request;
  *request.mutable_mesh()->mutable_arrays() = Chunk().chunk().arrays();
  RawConnection reader(server->port());
  reader.BeginHttp2();
  reader.SendCall(1, "/capfit.v1.BodyApproximationService/ApproximateBodyUnary");
  constexpr char kEndOfStream = 1;
  reader.SendFrame(FrameType::kData, 1, Framed(request.SerializeAsString()), kEndOfStream);
  // It lets 64 KB come and never asks for more.
  EXPECT_TRUE(WaitFor([&] {
    return server->MetricsText().find("capfit_refused_total{reason=\"READER_TOO_SLOW\"} 1") !=
           std::string::npos;
  }));
  EXPECT_TRUE(WaitFor([&] { return server->held_bytes() == 0; }));
  EXPECT_EQ(server->MetricsText().find("code=\"OK\",method=\"ApproximateBodyUnary\""),
            std::string::npos);
}

TEST(Limits, AFitThatTakesTooLongIsStoppedWithAReasonOfItsOwn) {
  Gate gate;
  ServerConfig config;
  config.max_fit_seconds = 0.2;
  const auto server = StartServer(WaitingBackend(gate), config);
  Call call(LoopbackChannel(*server));
  call.Send({Header(), Chunk()});
  const absl::Status status = EndOf(call);
  EXPECT_EQ(status.code(), absl::StatusCode::kDeadlineExceeded);
  EXPECT_EQ(ReasonOf(status), ErrorReason::kFitTooLong);
  EXPECT_THAT(std::string(status.message()), HasSubstr("0.2 s"));
}

TEST(Limits, ACallThatWaitsIsOverAsSoonAsItsCallerIs) {
  Gate gate;
  ServerConfig config;
  config.max_concurrent_fits = 1;
  const auto server = StartServer(WaitingBackend(gate), config);
  Call running(LoopbackChannel(*server));
  running.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  const std::int64_t held = server->held_bytes();
  Call waiting(LoopbackChannel(*server));
  waiting.Send({Header(), Chunk()});
  Call in_time(LoopbackChannel(*server), {}, 0.5);
  in_time.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return server->waiting_fits() == 2; }));
  waiting.context.TryCancel();
  EXPECT_EQ(waiting.Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_EQ(in_time.Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  // While the first one still runs.
  EXPECT_TRUE(WaitFor([&] { return server->held_bytes() <= held; }));
  EXPECT_EQ(server->waiting_fits(), 0U);
  gate.open = true;
  EXPECT_TRUE(running.Finish().ok());
}

TEST(Limits, WhoseDeadlinePassesBeforeItsTurnIsToldAtOnce) {
  Gate gate;
  ServerConfig config;
  config.max_concurrent_fits = 1;
  const auto server = StartServer(WaitingBackend(gate), config);
  // Each is expected to take .05 s or more.
  std::vector<std::unique_ptr<Call>> queue;
  for (int i = 0; i < 60; ++i) {
    queue.push_back(std::make_unique<Call>(LoopbackChannel(*server)));
    queue.back()->Send({Header(), Chunk()});
  }
  ASSERT_TRUE(WaitFor([&] { return server->waiting_fits() == 59; }));
  Call hasty(LoopbackChannel(*server), {}, 2.0);
  hasty.Send({Header(), Chunk()});
  const absl::Status status = EndOf(hasty);
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("its deadline passes in"));
  EXPECT_GE(std::atoi(hasty.Trailer("grpc-retry-pushback-ms").c_str()), 500);
  EXPECT_NE(server->MetricsText().find("capfit_refused_total{reason=\"deadline\"} 1"),
            std::string::npos);
  Call patient(LoopbackChannel(*server), {}, 60.0);
  patient.Send({Header(), Chunk()});
  EXPECT_TRUE(WaitFor([&] { return server->waiting_fits() == 60; }));
  gate.open = true;
  EXPECT_TRUE(patient.Finish().ok());
}

TEST(Limits, WhatTheGraceOfAStoppingServerCutsOffIsToldSo) {
  Gate gate;
  ServerConfig config;
  config.drain_seconds = 0.2;
  const auto server = StartServer(WaitingBackend(gate), config);
  Call call(LoopbackChannel(*server));
  call.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  std::thread drain([&] { server->Drain(); });
  const absl::Status status = EndOf(call);
  drain.join();
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(ReasonOf(status), ErrorReason::kServerStopping);
  EXPECT_THAT(std::string(status.message()), HasSubstr("within the 0.2 s that it had"));
}

TEST(Limits, PriorityIsOneOfTwoWords) {
  const auto server = StartServer(InstantBackend());
  for (const char* const word : {"interactive", "bulk"}) {
    Call call(LoopbackChannel(*server), {{"capfit-priority", word}});
    call.Send({Header(), Chunk()});
    EXPECT_TRUE(call.Finish().ok());
  }
  Call call(LoopbackChannel(*server), {{"capfit-priority", "urgent"}});
  const absl::Status status = EndOf(call);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr("\"urgent\", must be interactive or bulk"));
}

}  // namespace
}  // namespace capfit::server
