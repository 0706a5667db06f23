// Resident memory of a real server while clients do what they can to it, and others who are served.
#include <gmock/gmock.h>
#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/security/credentials.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "capfit/v1/service.grpc.pb.h"
#include "client/body_client.h"
#include "client/picture/write_mesh.h"
#include "core/mannequin/mannequin.h"
#include "tests/e2e/processes.h"
#include "tests/server/raw_connection.h"

namespace capfit::e2e {
namespace {

using server::FrameType;
using server::RawConnection;
using Stub = v1::BodyApproximationService::Stub;

constexpr int kHeldMib = 64;
// What fits work with, what gRPC keeps for each connection, and what an allocator does not give
// back: as large again as the budget. Anything that is not bounded passes this many times over.
constexpr double kBesideMib = 96.0;

// printf %s TOKEN | sha256sum, for the two below.
constexpr char kTokens[] =
    "crowd d7ecdf25eaf3deba0f2628771dbdd22d4138ab6cf38f91ed02a2ca0dec7c8ab7\n"
    "other 16367aacb67a4a017c8da8ab95682ccb390863780f7114dda0a0e0c55644c7c4\n";
constexpr char kCrowd[] = "open-sesame";
constexpr char kOther[] = "second";

std::string Body(int faces) {
  mannequin::MannequinOptions options;
  options.faces = faces;
  return client::PlyBytes(mannequin::MakeMannequin(options).value());
}

std::shared_ptr<grpc::Channel> OwnChannel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);  // takes 64 KiB before somebody reads, never more
  arguments.SetMaxSendMessageSize(-1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

class Memory : public testing::Test {
 protected:
  Memory() {
    // What a server needs once in its life is not what is looked for.
    EXPECT_TRUE(OtherIsServed());
    before_mib_ = server_.ResidentMib();
  }

  // Somebody else, who comes again as long as the server says so.
  bool OtherIsServed() {
    const absl::Status status = StatusOfOther();
    EXPECT_TRUE(status.ok()) << status;
    return status.ok();
  }

  absl::Status StatusOfOther() {
    client::Security security;
    security.token = kOther;
    const auto other = client::BodyClient::Connect(server_.address(), security);
    client::CallOptions call;
    call.max_attempts = 100;
    call.is_fresh = true;
    return other
        ->ApproximateFile(std::as_bytes(std::span(small_)), formats::MeshFormat::kPly, {}, call)
        .status();
  }

  // The most that the server ever held while `attack` ran, beyond what it held before.
  template <typename Attack>
  double GrowthDuring(const Attack& attack) {
    std::atomic<bool> is_over{false};
    double most_mib = before_mib_;
    std::thread watch([&] {
      while (!is_over) {
        most_mib = std::max(most_mib, server_.ResidentMib());
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
    attack();
    is_over = true;
    watch.join();
    std::cout << "resident MiB before " << before_mib_ << ", most " << most_mib << ", after "
              << server_.ResidentMib() << '\n';
    return most_mib - before_mib_;
  }

  // Afterwards, when what was held has been given back.
  double GrowthAfter() const { return server_.ResidentMib() - before_mib_; }

  static std::string TokenFile(const Scratch& scratch) {
    WriteText(scratch.Path("tokens"), kTokens);
    return scratch.Path("tokens");
  }

  Scratch scratch_;
  const std::string small_ = Body(2000);
  ServerProcess server_{{"--max-held-mb", std::to_string(kHeldMib), "--token-file",
                         TokenFile(scratch_), "--read-idle-seconds", "5", "--log-level", "warn"}};
  double before_mib_ = 0.0;
};

struct StalledReader {
  StalledReader(const std::string& address, const std::string& body)
      : stub(v1::BodyApproximationService::NewStub(OwnChannel(address))) {
    context.AddMetadata("authorization", std::string("Bearer ") + kCrowd);
    stream = stub->ApproximateBody(&context);
    v1::ApproximateBodyRequest request;
    request.mutable_header()->mutable_mesh()->mutable_file();
    request.mutable_header()->mutable_options()->set_skinning(v1::SKINNING_FORM_DENSE);
    stream->Write(request);
    request.mutable_chunk()->set_file_bytes(body);
    stream->Write(request);
    stream->WritesDone();
  }

  grpc::ClientContext context;
  std::unique_ptr<Stub> stub;
  std::unique_ptr<grpc::ClientReaderWriter<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>>
      stream;
};

TEST_F(Memory, AHundredReadersThatNeverReadStayWithinTheBudget) {
  const std::string body = Body(20'000);
  std::vector<std::unique_ptr<StalledReader>> readers;
  const double growth_mib = GrowthDuring([&] {
    for (int i = 0; i < 100; ++i) {
      readers.push_back(std::make_unique<StalledReader>(server_.address(), body));
    }
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(OtherIsServed());
    std::this_thread::sleep_for(std::chrono::seconds(6));  // until they are cut off
    EXPECT_TRUE(OtherIsServed());
  });
  EXPECT_LT(growth_mib, kHeldMib + kBesideMib);
}

// One message of `bytes` of nothing, as gRPC sends it: it says its length first.
grpc::Status SendOneMessage(const std::string& address, const grpc::Slice& bytes) {
  grpc::GenericStub stub(OwnChannel(address));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  context.AddMetadata("authorization", std::string("Bearer ") + kCrowd);
  const grpc::ByteBuffer request(&bytes, 1);
  grpc::ByteBuffer response;
  std::promise<grpc::Status> done;
  stub.UnaryCall(&context, "/capfit.v1.BodyApproximationService/ApproximateBodyUnary", {}, &request,
                 &response, [&](grpc::Status status) { done.set_value(std::move(status)); });
  return done.get_future().get();
}

TEST_F(Memory, MessagesOfAQuarterGigabyteEachStayBounded) {
  constexpr int kCallers = 8;
  // gRPC refuses what is beyond its quota when it has seen it, and where the machine is busy it
  // sees late: 70 to 110 MB mostly, once 232. Without the quota 2 GB.
  constexpr double kMostMib = 512.0;
  const std::string nothing(256 * 1024 * 1024, '\0');
  const grpc::Slice bytes(nothing.data(), nothing.size(), grpc::Slice::STATIC_SLICE);
  const double growth_mib = GrowthDuring([&] {
    std::vector<std::thread> callers;
    for (int i = 0; i < kCallers; ++i) {
      callers.emplace_back([&] {
        const grpc::Status status = SendOneMessage(server_.address(), bytes);
        // gRPC's resource quota ends them: too large is told only to who fits into that.
        EXPECT_THAT(status.error_code(), testing::AnyOf(grpc::StatusCode::RESOURCE_EXHAUSTED,
                                                        grpc::StatusCode::UNAVAILABLE,
                                                        grpc::StatusCode::INVALID_ARGUMENT));
      });
    }
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(OtherIsServed());
    for (std::thread& caller : callers) caller.join();
  });
  EXPECT_LT(growth_mib, kMostMib);
  EXPECT_TRUE(OtherIsServed());
}

// Begins `count` calls of a method on a connection of its own, and gives each up at once.
void BeginAndReset(const std::string& address, const std::string& method, std::uint32_t count) {
  RawConnection connection(std::stoi(address.substr(address.find(':') + 1)));
  connection.BeginHttp2();
  for (std::uint32_t i = 0; i < count; ++i) {
    connection.SendCall(2 * i + 1, "/capfit.v1.BodyApproximationService/" + method);
    connection.SendFrame(FrameType::kResetStream, 2 * i + 1, std::string("\0\0\0\x08", 4));
  }
  EXPECT_TRUE(connection.EndsWithin(/*seconds=*/20)) << "it is cut off";
}

// Without ResetGuard 2 GB for each of these, whether there is such a method or not. With it 30 to
// 70 MB mostly, and more where the machine is so busy that what came is seen late.
TEST_F(Memory, StreamsThatAreResetByTheHundredThousandStayBounded) {
  constexpr double kMostMib = 512.0;
  for (const char* const method : {"ApproximateBody", "ApproximateBodyUnary", "NoSuchMethod"}) {
    const double growth_mib =
        GrowthDuring([&] { BeginAndReset(server_.address(), method, 100'000); });
    EXPECT_LT(growth_mib, kMostMib) << method;
    EXPECT_TRUE(OtherIsServed());
  }
  EXPECT_THAT(server_.Log(), testing::HasSubstr("gave up more than 1000 calls within 10 s"));
}

// Half a million streams: without ResetGuard more than 4 GB, and with it 30 to 100 MB mostly; more
// where the machine is so busy that what came is seen late.
TEST_F(Memory, StreamsThatAreResetOnFiftyConnectionsAtOnceStayBounded) {
  constexpr double kMostMib = 1024.0;
  const double growth_mib = GrowthDuring([&] {
    std::vector<std::thread> attackers;
    for (int i = 0; i < 50; ++i) {
      attackers.emplace_back(
          [&] { BeginAndReset(server_.address(), "ApproximateBody", /*count=*/10'000); });
    }
    for (std::thread& attacker : attackers) attacker.join();
  });
  EXPECT_LT(growth_mib, kMostMib);
  // As soon as what came has been worked off; until then gRPC's own quota may refuse.
  absl::Status status = StatusOfOther();
  for (int i = 0; i < 40 && !status.ok(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    status = StatusOfOther();
  }
  EXPECT_TRUE(status.ok()) << status;
}

TEST_F(Memory, TenThousandWrongTokensLeaveNothingBehind) {
  const auto guess = [&](int first) {
    const auto stub = v1::BodyApproximationService::NewStub(OwnChannel(server_.address()));
    for (int i = first; i < first + 2'500; ++i) {
      grpc::ClientContext context;
      context.AddMetadata("authorization", "Bearer guess" + std::to_string(i));
      v1::GetServerInfoResponse info;
      EXPECT_EQ(stub->GetServerInfo(&context, {}, &info).error_code(),
                grpc::StatusCode::UNAUTHENTICATED);
    }
  };
  const double growth_mib = GrowthDuring([&] {
    std::vector<std::thread> attackers;
    for (int i = 0; i < 4; ++i) attackers.emplace_back(guess, 2'500 * i);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(OtherIsServed());
    for (std::thread& attacker : attackers) attacker.join();
  });
  EXPECT_LT(growth_mib, kBesideMib / 4);
}

}  // namespace
}  // namespace capfit::e2e
