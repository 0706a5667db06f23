// The JSON that files of engines are written in.
#ifndef CAPFIT_CORE_EXPORT_JSON_TEXT_H_
#define CAPFIT_CORE_EXPORT_JSON_TEXT_H_

#include <nlohmann/json.hpp>
#include <string>

#include "core/export/file_text.h"

namespace capfit::exports {

// An object with the statement's members, to which a format adds its own.
[[nodiscard]] nlohmann::ordered_json StatementJson(const Statement& statement);

// The text of an object: ASCII, a line for each member and for each entry of those that are lists;
// bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string JsonText(const nlohmann::ordered_json& json);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_JSON_TEXT_H_
