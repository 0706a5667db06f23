// The whole command line `capfit`.
#ifndef CAPFIT_CLIENT_COMMAND_LINE_H_
#define CAPFIT_CLIENT_COMMAND_LINE_H_

#include <string>
#include <vector>

namespace capfit::client {

// Runs it with the arguments after the program's name; the exit code (see exit_code.h).
[[nodiscard]] int RunCommandLine(const std::vector<std::string>& arguments);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_COMMAND_LINE_H_
