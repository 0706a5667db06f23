#include "core/export/json_text.h"

namespace capfit::exports {
namespace {

using OrderedJson = nlohmann::ordered_json;

}  // namespace

OrderedJson StatementJson(const Statement& statement) {
  OrderedJson json = OrderedJson::object();
  for (const auto& [key, value] : statement) json[key] = value;
  return json;
}

std::string JsonText(const OrderedJson& json) {
  return json.dump(1, ' ', true, OrderedJson::error_handler_t::replace) + "\n";
}

// The library's own way of mending bytes: out as a string of JSON, and in again.
std::string ValidUtf8(const std::string& text) {
  const std::string quoted = OrderedJson(text).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  return OrderedJson::parse(quoted).get<std::string>();
}

}  // namespace capfit::exports
