#include "client/help_format.h"

#include <algorithm>
#include <sstream>

namespace capfit::client {
namespace {

constexpr std::size_t kColumns = 100;

}  // namespace

// CLI11 gives "TEXT:{a,b}" for a choice and "INT:INT in [0 - 256]" for a range.
std::string ShownType(const CLI::Option& option) {
  std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  const std::size_t brace = type.find('{');
  if (brace != std::string::npos && type.find('}') != std::string::npos) {
    type = type.substr(brace + 1, type.find('}') - brace - 1);
    std::replace(type.begin(), type.end(), ',', '|');
    return type;
  }
  // (A colon of ours stands in brackets: "HOST[:PORT]".)
  const bool is_ours = colon != std::string::npos && colon > 0 && type[colon - 1] == '[';
  return colon == std::string::npos || is_ours ? type : type.substr(0, colon);
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  if (option->get_type_size() == 0) return "";
  std::string text = " " + ShownType(*option);
  if (!option->get_default_str().empty()) text += "=" + option->get_default_str();
  if (option->get_required() && option->nonpositional()) text += " (required)";
  return text;
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  const std::size_t width = kColumns - get_column_width();
  std::istringstream words(option->get_description());
  std::string text;
  std::string line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      text += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line;
}

}  // namespace capfit::client
