#include "core/export/json_text.h"

namespace capfit::exports {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string Compact(const OrderedJson& value) {
  return value.dump(-1, ' ', true, OrderedJson::error_handler_t::replace);
}

// Entries of lists one a line.
std::string MemberText(const OrderedJson& member) {
  if (!member.is_array() || member.empty()) return Compact(member);
  std::string text = "[";
  for (const OrderedJson& entry : member) {
    text += (text.size() == 1 ? "\n  " : ",\n  ") + Compact(entry);
  }
  return text + "\n ]";
}

}  // namespace

OrderedJson StatementJson(const Statement& statement) {
  OrderedJson json = OrderedJson::object();
  for (const auto& [key, value] : statement) json[key] = value;
  json["format_version"] = kFormatVersion;
  return json;
}

std::string JsonText(const OrderedJson& json) {
  std::string text = "{";
  for (const auto& [key, member] : json.items()) {
    text += (text.size() == 1 ? "\n " : ",\n ") + Compact(key) + ": " + MemberText(member);
  }
  return text + "\n}\n";
}

}  // namespace capfit::exports
