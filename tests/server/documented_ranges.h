// What the comments of the contract say of each field: "Range: [low, high]".
#ifndef CAPFIT_TESTS_SERVER_DOCUMENTED_RANGES_H_
#define CAPFIT_TESTS_SERVER_DOCUMENTED_RANGES_H_

#include <map>
#include <string>
#include <vector>

namespace capfit::server {

// By "Message.field", the text between and with the brackets: "[15, 1000]", "(0, inf)". Reads the
// proto files themselves, because compiled descriptors have no comments.
[[nodiscard]] std::map<std::string, std::string> DocumentedRanges(
    const std::vector<std::string>& proto_files);

// Whether `value` lies in a range whose ends are numbers or inf; throws std::invalid_argument where
// they are words.
[[nodiscard]] bool LiesIn(double value, const std::string& range);

}  // namespace capfit::server

#endif  // CAPFIT_TESTS_SERVER_DOCUMENTED_RANGES_H_
