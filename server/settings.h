// One vocabulary for the command line, the environment and a file.
#ifndef CAPFIT_SERVER_SETTINGS_H_
#define CAPFIT_SERVER_SETTINGS_H_

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "absl/status/status.h"

namespace capfit::server {

// The name of a flag in the environment: "drain-seconds" is CAPFIT_DRAIN_SECONDS.
[[nodiscard]] std::string EnvironmentName(const std::string& flag);

// Gives the options of `app` their values: from `arguments` (the words after the program's name),
// else from the environment, else from the file of lines `name = value` (TOML without sections)
// that the option --config names, else their defaults. Every configurable option takes part, by its
// long name. An empty value in the environment or the file counts as none.
//
// INVALID_ARGUMENT says where the value stands, what is wrong and what it may be; for an unknown
// name the nearest one. What the command line itself may end with (help, version, a wrong flag) is
// thrown as CLI11 throws it.
[[nodiscard]] absl::Status ReadSettings(CLI::App& app, const std::vector<std::string>& arguments);

// "CAPFIT_THREDS is no setting; did you mean CAPFIT_THREADS?" for each variable of the environment
// that begins as settings do, is none, and looks like one of `app`, in alphabetical order. Others
// are not ours to judge: Kubernetes makes some, as do the caller's own scripts.
[[nodiscard]] std::vector<std::string> DoubtfulVariables(const CLI::App& app);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SETTINGS_H_
