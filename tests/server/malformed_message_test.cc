// What a server says of bytes that are no message of the contract.
#include <gmock/gmock.h>
#include <grpcpp/impl/client_unary_call.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/sync_stream.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "proto/wire/status_conversion.h"
#include "tests/server/fake_fit.h"
#include "tests/server/service_call.h"

namespace capfit::server {
namespace {

using grpc::internal::RpcMethod;

grpc::ByteBuffer BufferOf(const std::string& bytes) {
  const grpc::Slice slice(bytes);
  return {&slice, 1};
}

std::string MethodName(const std::string& method) {
  return std::string("/") + v1::BodyApproximationService::service_full_name() + "/" + method;
}

absl::Status Upload(Server& server, const std::vector<std::string>& messages) {
  const std::shared_ptr<grpc::Channel> channel = LoopbackChannel(server);
  const std::string name = MethodName("ApproximateBody");
  const RpcMethod method(name.c_str(), RpcMethod::BIDI_STREAMING, channel);
  grpc::ClientContext context;
  const std::unique_ptr<grpc::ClientReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>> stream(
      grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, grpc::ByteBuffer>::Create(
          channel.get(), method, &context));
  for (const std::string& message : messages) stream->Write(BufferOf(message));
  stream->WritesDone();
  for (grpc::ByteBuffer answer; stream->Read(&answer);) {
  }
  return wire::FromGrpcStatus(stream->Finish());
}

absl::Status Ask(Server& server, const std::string& unary_method, const std::string& message) {
  const std::shared_ptr<grpc::Channel> channel = LoopbackChannel(server);
  const std::string name = MethodName(unary_method);
  const RpcMethod method(name.c_str(), RpcMethod::NORMAL_RPC, channel);
  grpc::ClientContext context;
  grpc::ByteBuffer answer;
  return wire::FromGrpcStatus(grpc::internal::BlockingUnaryCall<grpc::ByteBuffer, grpc::ByteBuffer>(
      channel.get(), method, &context, BufferOf(message), &answer));
}

void ExpectMalformed(const absl::Status& status, const std::string& text) {
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_EQ(ReasonOf(status), ErrorReason::kMalformedMessage) << status;
  EXPECT_THAT(std::string(status.message()), testing::StartsWith(text));
}

std::string CutShort(const v1::ApproximateBodyRequest& request) {
  const std::string whole = request.SerializeAsString();
  return whole.substr(0, whole.size() - 1);
}

TEST(MalformedMessage, IsNotTheEndOfAnUpload) {
  const auto server = StartServer(InstantBackend());
  const std::string header = Header().SerializeAsString();
  const std::string chunk = Chunk().SerializeAsString();
  EXPECT_TRUE(Upload(*server, {header, chunk}).ok());
  ExpectMalformed(Upload(*server, {header, chunk, CutShort(Chunk())}),
                  "message 3 of the upload, of " + std::to_string(chunk.size() - 1) +
                      " bytes, is no capfit.v1.ApproximateBodyRequest: ");
  ExpectMalformed(Upload(*server, {CutShort(Header("an id"))}), "message 1 of the upload");
}

TEST(MalformedMessage, IsNamedInUnaryCalls) {
  const auto server = StartServer(InstantBackend());
  ExpectMalformed(Ask(*server, "ApproximateBodyUnary", "\x0a\xff"),
                  "the request, of 2 bytes, is no capfit.v1.ApproximateBodyUnaryRequest: ");
  ExpectMalformed(Ask(*server, "GetServerInfo", "\x07"),
                  "the request, of 1 bytes, is no capfit.v1.GetServerInfoRequest: ");
  EXPECT_TRUE(Ask(*server, "GetServerInfo", "").ok());
}

TEST(MalformedMessage, IsOneWhoseTextIsNotUtf8) {
  const auto server = StartServer(InstantBackend());
  std::string header = Header("sixchr").SerializeAsString();
  header[header.find("sixchr")] = '\xfc';  // a Latin u with dots
  ExpectMalformed(Upload(*server, {header}), "message 1 of the upload");
}

TEST(MalformedMessage, IsCountedAndLeavesNothingHeld) {
  const auto server = StartServer(InstantBackend());
  ExpectMalformed(Upload(*server, {CutShort(Header("an id"))}), "message 1");
  ExpectMalformed(Ask(*server, "ApproximateBodyUnary", "\x0a\xff"), "the request");
  EXPECT_TRUE(WaitFor([&] { return server->held_bytes() == 0; }));
  EXPECT_THAT(server->MetricsText(), testing::HasSubstr("INVALID_ARGUMENT"));
}

}  // namespace
}  // namespace capfit::server
