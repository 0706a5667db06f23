// Messages between bytes and protobuf. gRPC's own reader calls a stream ended where a message does
// not decode, and a body that was cut short would be fitted; read by hand, its caller is told.
#ifndef CAPFIT_SERVER_RAW_MESSAGE_H_
#define CAPFIT_SERVER_RAW_MESSAGE_H_

#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/byte_buffer.h>

#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::server {

// Decodes `bytes` and lets go of them. INVALID_ARGUMENT MALFORMED_MESSAGE where they are no such
// message; `what` names it: "message 3 of the upload".
template <typename Message>
[[nodiscard]] absl::Status Decode(grpc::ByteBuffer& bytes, const std::string& what,
                                  Message& message) {
  const std::size_t size = bytes.Length();
  message.Clear();
  // A message of no bytes is one whose fields all have their defaults.
  const bool is_read =
      size == 0 || grpc::SerializationTraits<Message>::Deserialize(&bytes, &message).ok();
  bytes.Clear();
  if (is_read) return absl::OkStatus();
  return Refused(ErrorReason::kMalformedMessage,
                 absl::StrCat(what, ", of ", size, " bytes, is no ", message.GetTypeName(),
                              ": it was cut or changed on its way, made from another contract, or "
                              "has a text that is not UTF-8"));
}

// INTERNAL where it is too large for any message.
template <typename Message>
[[nodiscard]] absl::Status Encode(const Message& message, grpc::ByteBuffer& bytes) {
  bytes.Clear();  // of what was sent before
  bool owns_buffer = false;
  const grpc::Status status =
      grpc::SerializationTraits<Message>::Serialize(message, &bytes, &owns_buffer);
  if (status.ok()) return absl::OkStatus();
  return Refused(ErrorReason::kInternal,
                 absl::StrCat("the answer cannot be encoded: ", status.error_message()));
}

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_RAW_MESSAGE_H_
