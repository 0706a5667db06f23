// capfit.v1.BodyApproximationService on gRPC's callback API.
#ifndef CAPFIT_SERVER_SERVICE_H_
#define CAPFIT_SERVER_SERVICE_H_

#include "capfit/v1/service.grpc.pb.h"
#include "server/call_services.h"
#include "server/caller_check.h"

namespace capfit::server {

// Asks who calls, starts one object for each call, and answers what needs no work at once.
class Service final : public v1::BodyApproximationService::CallbackService {
 public:
  Service(const CallServices& services, CallerCheck callers, v1::GetServerInfoResponse info)
      : services_(services), callers_(std::move(callers)), info_(std::move(info)) {}

  grpc::ServerBidiReactor<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>* ApproximateBody(
      grpc::CallbackServerContext* context) override;

  grpc::ServerUnaryReactor* ApproximateBodyUnary(
      grpc::CallbackServerContext* context, const v1::ApproximateBodyUnaryRequest* request,
      v1::ApproximateBodyUnaryResponse* response) override;

  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest* request,
                                          v1::GetServerInfoResponse* response) override;

 private:
  // As CallerCheck::NameOf; who is refused is counted.
  [[nodiscard]] absl::StatusOr<std::string> CallerOf(const char* method,
                                                     const grpc::CallbackServerContext& context);

  const CallServices services_;
  CallerCheck callers_;
  const v1::GetServerInfoResponse info_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SERVICE_H_
