// capfit.v1.BodyApproximationService on gRPC's callback API.
#ifndef CAPFIT_SERVER_SERVICE_H_
#define CAPFIT_SERVER_SERVICE_H_

#include <grpcpp/support/byte_buffer.h>

#include "capfit/v1/service.grpc.pb.h"
#include "server/call_services.h"
#include "server/caller_check.h"

namespace capfit::server {

// The generated service with messages as bytes (see raw_message.h).
using RawService = v1::BodyApproximationService::WithRawCallbackMethod_ApproximateBody<
    v1::BodyApproximationService::WithRawCallbackMethod_ApproximateBodyUnary<
        v1::BodyApproximationService::WithRawCallbackMethod_GetServerInfo<
            v1::BodyApproximationService::Service>>>;

// Asks who calls, starts one object for each call, and answers what needs no work at once.
class Service final : public RawService {
 public:
  Service(const CallServices& services, CallerCheck callers, v1::GetServerInfoResponse info)
      : services_(services), callers_(std::move(callers)), info_(std::move(info)) {}

  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* ApproximateBody(
      grpc::CallbackServerContext* context) override;

  grpc::ServerUnaryReactor* ApproximateBodyUnary(grpc::CallbackServerContext* context,
                                                 const grpc::ByteBuffer* request,
                                                 grpc::ByteBuffer* response) override;

  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const grpc::ByteBuffer* request,
                                          grpc::ByteBuffer* response) override;

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
