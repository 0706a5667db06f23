// Messages of the contract as JSON of the result file.
#ifndef CAPFIT_CLIENT_MESSAGE_JSON_H_
#define CAPFIT_CLIENT_MESSAGE_JSON_H_

#include <google/protobuf/message.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace capfit::client {

// The members of `message` under the contract's own names and in its order, so that file and wire
// cannot come to differ. Numbers are numbers (uint64 too), Vector3 is [x, y, z], enums are words
// (see EnumWord) and null where unspecified; `optional` fields that are not set are left out.
[[nodiscard]] nlohmann::ordered_json MessageJson(const google::protobuf::Message& message);

// FIT_MODE_BEST_FIT of FitMode gives "best_fit".
[[nodiscard]] std::string EnumWord(const google::protobuf::EnumValueDescriptor& value);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_MESSAGE_JSON_H_
