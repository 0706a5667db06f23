#include "tests/server/documented_ranges.h"

#include <fstream>
#include <regex>

namespace capfit::server {

std::map<std::string, std::string> DocumentedRanges(const std::vector<std::string>& proto_files) {
  const std::regex message_line(R"(^message (\w+) \{.*)");
  const std::regex field_line(R"(^\s+(?:repeated |optional )?[\w.]+ (\w+) = \d+;.*)");
  const std::regex range_text(R"(Range: ([\[(][^\])]*[\])]))");
  std::map<std::string, std::string> ranges;
  for (const std::string& file : proto_files) {
    std::ifstream in(file);
    std::string message;
    std::string comment;
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      const std::size_t start = line.find("// ");
      if (start != std::string::npos) {
        comment += line.substr(start + 2);
        continue;
      }
      if (std::regex_match(line, match, message_line)) {
        message = match[1];
      } else if (std::regex_match(line, match, field_line)) {
        const std::string field = message + "." + match[1].str();
        if (std::regex_search(comment, match, range_text)) ranges[field] = match[1];
      }
      comment.clear();
    }
  }
  return ranges;
}

bool LiesIn(double value, const std::string& range) {
  const std::size_t comma = range.find(',');
  const double low = std::stod(range.substr(1, comma - 1));
  const double high = std::stod(range.substr(comma + 1));
  return (range.front() == '[' ? value >= low : value > low) &&
         (range.back() == ']' ? value <= high : value < high);
}

}  // namespace capfit::server
