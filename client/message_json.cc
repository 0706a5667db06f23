#include "client/message_json.h"

#include <google/protobuf/descriptor.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "absl/strings/ascii.h"
#include "capfit/v1/mesh.pb.h"

namespace capfit::client {
namespace {

using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using nlohmann::ordered_json;

// "FitMode" gives "FIT_MODE_".
std::string PrefixOf(const std::string& enum_name) {
  std::string prefix;
  for (const char letter : enum_name) {
    if (!prefix.empty() && std::isupper(static_cast<unsigned char>(letter)) != 0) prefix += '_';
    prefix += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  return prefix + "_";
}

ordered_json EnumJson(const EnumValueDescriptor& value) {
  return value.number() == 0 ? ordered_json(nullptr) : ordered_json(EnumWord(value));
}

ordered_json SubMessageJson(const Message& message) {
  if (message.GetDescriptor() != v1::Vector3::descriptor()) return MessageJson(message);
  const auto& vector = static_cast<const v1::Vector3&>(message);
  return ordered_json::array({vector.x(), vector.y(), vector.z()});
}

// One value of a field: `index` counts within a repeated field.
ordered_json RepeatedJson(const Message& message, const FieldDescriptor& field, int index) {
  const google::protobuf::Reflection& look = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return look.GetRepeatedDouble(message, &field, index);
    case FieldDescriptor::CPPTYPE_STRING:
      return look.GetRepeatedString(message, &field, index);
    case FieldDescriptor::CPPTYPE_ENUM:
      return EnumJson(*look.GetRepeatedEnum(message, &field, index));
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return SubMessageJson(look.GetRepeatedMessage(message, &field, index));
    default:
      return nullptr;  // the summary repeats nothing else
  }
}

ordered_json SingleJson(const Message& message, const FieldDescriptor& field) {
  const google::protobuf::Reflection& look = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return look.GetDouble(message, &field);
    case FieldDescriptor::CPPTYPE_INT32:
      return look.GetInt32(message, &field);
    case FieldDescriptor::CPPTYPE_INT64:
      return look.GetInt64(message, &field);
    case FieldDescriptor::CPPTYPE_UINT64:
      return look.GetUInt64(message, &field);
    case FieldDescriptor::CPPTYPE_BOOL:
      return look.GetBool(message, &field);
    case FieldDescriptor::CPPTYPE_STRING:
      return look.GetString(message, &field);
    case FieldDescriptor::CPPTYPE_ENUM:
      return EnumJson(*look.GetEnum(message, &field));
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return SubMessageJson(look.GetMessage(message, &field));
    default:
      return nullptr;  // the summary has nothing else
  }
}

}  // namespace

std::string EnumWord(const EnumValueDescriptor& value) {
  const std::string prefix = PrefixOf(value.type()->name());
  const std::string& name = value.name();
  return absl::AsciiStrToLower(
      name.compare(0, prefix.size(), prefix) == 0 ? name.substr(prefix.size()) : name);
}

ordered_json MessageJson(const Message& message) {
  ordered_json json = ordered_json::object();
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *message.GetDescriptor()->field(i);
    if (field.is_repeated()) {
      ordered_json& list = json[field.name()] = ordered_json::array();
      const int size = message.GetReflection()->FieldSize(message, &field);
      for (int k = 0; k < size; ++k) list.push_back(RepeatedJson(message, field, k));
    } else if (!field.has_optional_keyword() ||
               message.GetReflection()->HasField(message, &field)) {
      json[field.name()] = SingleJson(message, field);
    }
  }
  return json;
}

}  // namespace capfit::client
