#include "server/service.h"

namespace capfit::server {

grpc::ServerBidiReactor<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>*
Service::ApproximateBody(grpc::CallbackServerContext* context) {
  return ApproximateBodyCall::Start(context, services_);
}

grpc::ServerUnaryReactor* Service::GetServerInfo(grpc::CallbackServerContext* context,
                                                 const v1::GetServerInfoRequest* /*request*/,
                                                 v1::GetServerInfoResponse* response) {
  *response = info_;
  grpc::ServerUnaryReactor* const reactor = context->DefaultReactor();
  reactor->Finish(grpc::Status::OK);
  return reactor;
}

}  // namespace capfit::server
