// `capfit export`: a result as files that engines load.
#ifndef CAPFIT_CLIENT_EXPORT_COMMAND_H_
#define CAPFIT_CLIENT_EXPORT_COMMAND_H_

#include <CLI/CLI.hpp>
#include <string>

#include "absl/status/status.h"
#include "core/export/collider_set.h"

namespace capfit::client {

void AddExportCommand(CLI::App& app, int& exit_code);

// Writes the file into the folder, which is made where it is not there, and prints its name unless
// `quiet`. NOT_FOUND names what cannot be written.
[[nodiscard]] absl::Status WriteExportFile(const exports::ExportFile& file,
                                           const std::string& folder, bool quiet);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_EXPORT_COMMAND_H_
