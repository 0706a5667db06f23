#include "server/service.h"

#include "server/approximate_body_call.h"
#include "server/approximate_body_unary_call.h"

namespace capfit::server {

grpc::ServerBidiReactor<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>*
Service::ApproximateBody(grpc::CallbackServerContext* context) {
  return ApproximateBodyCall::Start(context, services_);
}

grpc::ServerUnaryReactor* Service::ApproximateBodyUnary(
    grpc::CallbackServerContext* context, const v1::ApproximateBodyUnaryRequest* request,
    v1::ApproximateBodyUnaryResponse* response) {
  return ApproximateBodyUnaryCall::Start(context, request, response, services_);
}

grpc::ServerUnaryReactor* Service::GetServerInfo(grpc::CallbackServerContext* context,
                                                 const v1::GetServerInfoRequest* /*request*/,
                                                 v1::GetServerInfoResponse* response) {
  *response = info_;
  services_.metrics.CountAnswered("GetServerInfo");
  grpc::ServerUnaryReactor* const reactor = context->DefaultReactor();
  reactor->Finish(grpc::Status::OK);
  return reactor;
}

}  // namespace capfit::server
