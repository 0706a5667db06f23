#include "tests/server/service_call.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <gtest/gtest.h>

#include <utility>

namespace capfit::server {

std::unique_ptr<Server> StartServer(FitBackend backend, ServerConfig config) {
  config.listen = "127.0.0.1:0";
  config.threads = 1;
  auto server = Server::Start(config, std::move(backend));
  EXPECT_TRUE(server.ok()) << server.status();
  return *std::move(server);
}

std::shared_ptr<grpc::Channel> LoopbackChannel(const Server& server) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(server.port()),
                                   grpc::InsecureChannelCredentials(), arguments);
}

v1::ApproximateBodyRequest Header(const std::string& request_id) {
  v1::ApproximateBodyRequest request;
  request.mutable_header()->mutable_mesh()->mutable_arrays();
  request.mutable_header()->set_request_id(request_id);
  return request;
}

v1::ApproximateBodyRequest Chunk() {
  v1::ApproximateBodyRequest request;
  v1::MeshArrays& arrays = *request.mutable_chunk()->mutable_arrays();
  for (int i = 0; i < 9; ++i) arrays.add_positions(static_cast<float>(i));
  for (const std::uint32_t i : {0U, 1U, 2U}) arrays.add_triangle_indices(i);
  return request;
}

v1::ApproximateBodyRequest Positions(int vertices) {
  v1::ApproximateBodyRequest request;
  v1::MeshArrays& arrays = *request.mutable_chunk()->mutable_arrays();
  for (int i = 0; i < 3 * vertices; ++i) arrays.add_positions(static_cast<float>(i));
  return request;
}

Call::Call(const std::shared_ptr<grpc::Channel>& channel,
           const std::vector<std::pair<std::string, std::string>>& metadata, double timeout_seconds)
    : stub(v1::BodyApproximationService::NewStub(channel)) {
  for (const auto& [key, value] : metadata) context.AddMetadata(key, value);
  if (timeout_seconds > 0.0) {
    context.set_deadline(std::chrono::system_clock::now() +
                         std::chrono::milliseconds(static_cast<int>(1000.0 * timeout_seconds)));
  }
  stream = stub->ApproximateBody(&context);
}

void Call::Send(const std::vector<v1::ApproximateBodyRequest>& requests) {
  for (const v1::ApproximateBodyRequest& request : requests) stream->Write(request);
  stream->WritesDone();
}

grpc::Status Call::Finish() {
  v1::ApproximateBodyResponse response;
  while (stream->Read(&response)) responses.push_back(response);
  return stream->Finish();
}

std::string Call::Trailer(const std::string& key) const {
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto found = trailers.find(key);
  if (found == trailers.end()) return "";
  return {found->second.data(), found->second.size()};
}

}  // namespace capfit::server
