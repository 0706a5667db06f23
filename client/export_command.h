// `capfit export`: a result as files that engines load.
#ifndef CAPFIT_CLIENT_EXPORT_COMMAND_H_
#define CAPFIT_CLIENT_EXPORT_COMMAND_H_

#include <CLI/CLI.hpp>
#include <string>

#include "absl/status/status.h"
#include "core/export/collider_set.h"

namespace capfit::client {

void AddExportCommand(CLI::App& app, int& exit_code);

// Writes the files into the folder, which is made where it is not there, prints the warnings and,
// unless `quiet`, the names. NOT_FOUND names what cannot be written.
[[nodiscard]] absl::Status WriteExport(const exports::Exported& exported, const std::string& folder,
                                       bool quiet);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_EXPORT_COMMAND_H_
