// Fields that a caller's contract has and ours has not.
#ifndef CAPFIT_PROTO_WIRE_UNKNOWN_FIELDS_H_
#define CAPFIT_PROTO_WIRE_UNKNOWN_FIELDS_H_

#include <google/protobuf/message.h>

#include <optional>

#include "core/base/warning.h"

namespace capfit::wire {

// The warning UNKNOWN_FIELDS that names the numbers of all unknown fields of `message` and of the
// messages in it, by the path of the message that has them; nothing where all are known. Without
// it an option of a later version, or one that stands in the wrong message, would silently mean the
// default. O(fields that are set), packed arrays count as one.
[[nodiscard]] std::optional<Warning> UnknownFieldsOf(const google::protobuf::Message& message);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_UNKNOWN_FIELDS_H_
