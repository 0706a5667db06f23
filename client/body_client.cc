#include "client/body_client.h"

#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/retries.h"
#include "core/base/status.h"
#include "proto/wire/enum_conversion.h"
#include "proto/wire/options_conversion.h"
#include "proto/wire/result_collector.h"
#include "proto/wire/status_conversion.h"

namespace capfit::client {
namespace {

constexpr std::size_t kChunkBytes = 256 * 1024;

using Stream = grpc::ClientReaderWriter<v1::ApproximateBodyRequest, v1::ApproximateBodyResponse>;

// Sends `total` elements in pieces: fill(begin, end, request) makes one message. False: the server
// has ended the call, and its status says why.
template <typename Fill>
bool SendPieces(Stream& stream, std::size_t total, std::size_t element_bytes, const Fill& fill) {
  const std::size_t step = kChunkBytes / element_bytes;
  for (std::size_t begin = 0; begin < total; begin += step) {
    v1::ApproximateBodyRequest request;
    fill(begin, std::min(total, begin + step), request);
    if (!stream.Write(request)) return false;
  }
  return true;
}

bool SendPositions(Stream& stream, const std::vector<Eigen::Vector3d>& positions) {
  return SendPieces(stream, positions.size(), sizeof(Eigen::Vector3d),
                    [&](std::size_t begin, std::size_t end, v1::ApproximateBodyRequest& request) {
                      v1::MeshArrays& arrays = *request.mutable_chunk()->mutable_arrays();
                      const double* const data = positions[0].data();
                      arrays.mutable_positions_double()->Add(data + 3 * begin, data + 3 * end);
                    });
}

// `field` is one of the mutable_... functions of MeshArrays.
template <typename Field>
bool SendNumbers(Stream& stream, const std::vector<std::uint32_t>& numbers, const Field& field) {
  return SendPieces(stream, numbers.size(), sizeof(std::uint32_t),
                    [&](std::size_t begin, std::size_t end, v1::ApproximateBodyRequest& request) {
                      (request.mutable_chunk()->mutable_arrays()->*field)()->Add(
                          numbers.data() + begin, numbers.data() + end);
                    });
}

bool SendArrays(Stream& stream, const formats::PolygonSoup& soup) {
  using Arrays = v1::MeshArrays;
  using Numbers = google::protobuf::RepeatedField<std::uint32_t>* (Arrays::*)();
  const Numbers triangles = &Arrays::mutable_triangle_indices;
  const Numbers sizes = &Arrays::mutable_face_sizes;
  const Numbers corners = &Arrays::mutable_face_indices;
  if (!SendPositions(stream, soup.positions)) return false;
  if (soup.face_sizes.empty()) return SendNumbers(stream, soup.face_vertices, triangles);
  return SendNumbers(stream, soup.face_sizes, sizes) &&
         SendNumbers(stream, soup.face_vertices, corners);
}

bool SendFile(Stream& stream, std::span<const std::byte> bytes) {
  return SendPieces(stream, bytes.size(), 1,
                    [&](std::size_t begin, std::size_t end, v1::ApproximateBodyRequest& request) {
                      request.mutable_chunk()->set_file_bytes(bytes.data() + begin, end - begin);
                    });
}

// What the wire cannot even say (two budgets, no parts) is refused here; what a later server may
// have learnt (UNIMPLEMENTED) is left to the server.
absl::Status CheckOptions(const pipeline::FitOptions& options) {
  const absl::Status status = pipeline::ValidateOptions(options);
  return absl::IsUnimplemented(status) ? absl::OkStatus() : status;
}

// One attempt: the header, what `send` sends, then the answer.
template <typename Send>
absl::StatusOr<pipeline::FitResult> TryOnce(v1::BodyApproximationService::Stub& stub,
                                            grpc::ClientContext& context,
                                            const v1::ApproximateBodyRequest& first,
                                            const ProgressFunction& on_progress, const Send& send) {
  const std::unique_ptr<Stream> stream = stub.ApproximateBody(&context);
  if (stream->Write(first) && send(*stream)) stream->WritesDone();
  wire::ResultCollector collector(on_progress);
  absl::Status broken;
  v1::ApproximateBodyResponse response;
  while (broken.ok() && stream->Read(&response)) broken = collector.Add(response);
  if (!broken.ok()) context.TryCancel();
  const grpc::Status status = stream->Finish();
  if (!broken.ok()) return broken;
  if (!status.ok()) return wire::FromGrpcStatus(status);
  return std::move(collector).Finish();
}

void AddCallMetadata(const std::string& token, const CallOptions& call,
                     grpc::ClientContext& context) {
  AddToken(token, context);
  if (call.is_bulk) context.AddMetadata("capfit-priority", "bulk");
  if (call.is_fresh) context.AddMetadata("cache-control", "no-cache");
}

template <typename Send>
absl::StatusOr<pipeline::FitResult> Approximate(v1::BodyApproximationService::Stub& stub,
                                                const std::string& token,
                                                v1::ApproximateBodyHeader header,
                                                const pipeline::FitOptions& options,
                                                const CallOptions& call, const Send& send) {
  CAPFIT_RETURN_IF_ERROR(CheckOptions(options));
  wire::OptionsToWire(options, header);
  header.set_request_id(call.request_id);
  v1::ApproximateBodyRequest first;
  *first.mutable_header() = std::move(header);
  return WithRetries(call.timeout_seconds, call.max_attempts, [&](grpc::ClientContext& context) {
    AddCallMetadata(token, call, context);
    return TryOnce(stub, context, first, call.on_progress, send);
  });
}

}  // namespace

BodyClient BodyClient::Connect(const std::string& address) {
  absl::StatusOr<BodyClient> client = Connect(address, Security());
  if (client.ok()) return *std::move(client);
  // What is no address fails with the first call.
  return BodyClient(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
}

absl::StatusOr<BodyClient> BodyClient::Connect(const std::string& addresses,
                                               const Security& security) {
  CAPFIT_ASSIGN_OR_RETURN(const std::shared_ptr<grpc::Channel> channel,
                          OpenChannel(addresses, security));
  return BodyClient(channel, security.token);
}

BodyClient::BodyClient(const std::shared_ptr<grpc::Channel>& channel, const std::string& token)
    : stub_(v1::BodyApproximationService::NewStub(channel)), token_(token) {}

absl::StatusOr<pipeline::FitResult> BodyClient::ApproximateFile(std::span<const std::byte> bytes,
                                                                formats::MeshFormat format,
                                                                const pipeline::FitOptions& options,
                                                                const CallOptions& call) const {
  v1::ApproximateBodyHeader header;
  header.mutable_mesh()->mutable_file()->set_format(wire::ToWire(format));
  header.mutable_mesh()->mutable_file()->set_byte_count(static_cast<std::int64_t>(bytes.size()));
  return Approximate(*stub_, token_, std::move(header), options, call,
                     [bytes](Stream& stream) { return SendFile(stream, bytes); });
}

absl::StatusOr<pipeline::FitResult> BodyClient::ApproximateMesh(const formats::PolygonSoup& soup,
                                                                const pipeline::FitOptions& options,
                                                                const CallOptions& call) const {
  v1::ApproximateBodyHeader header;
  v1::ArrayEncoding& arrays = *header.mutable_mesh()->mutable_arrays();
  arrays.set_vertex_count(static_cast<int>(soup.positions.size()));
  arrays.set_face_count(static_cast<int>(soup.face_sizes.empty() ? soup.face_vertices.size() / 3
                                                                 : soup.face_sizes.size()));
  return Approximate(*stub_, token_, std::move(header), options, call,
                     [&soup](Stream& stream) { return SendArrays(stream, soup); });
}

absl::StatusOr<v1::GetServerInfoResponse> BodyClient::GetServerInfo(double timeout_seconds) const {
  return WithRetries(
      timeout_seconds, kMaxAttempts,
      [this](grpc::ClientContext& context) -> absl::StatusOr<v1::GetServerInfoResponse> {
        AddToken(token_, context);
        v1::GetServerInfoResponse info;
        const grpc::Status status = stub_->GetServerInfo(&context, {}, &info);
        if (!status.ok()) return wire::FromGrpcStatus(status);
        return info;
      });
}

}  // namespace capfit::client
