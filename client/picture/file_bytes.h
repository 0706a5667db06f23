// Whole files in and out.
#ifndef CAPFIT_CLIENT_PICTURE_FILE_BYTES_H_
#define CAPFIT_CLIENT_PICTURE_FILE_BYTES_H_

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace capfit::client {

// NOT_FOUND with the name where the file cannot be read.
[[nodiscard]] absl::StatusOr<std::string> ReadFileBytes(const std::string& path);

// UNAVAILABLE with the name where the file cannot be written.
[[nodiscard]] absl::Status WriteFileBytes(const std::string& path, const std::string& bytes);

// The ending of a file name in small letters, with its dot: ".png"; "" where it has none.
[[nodiscard]] std::string FileEnding(const std::string& path);

// Prints an error that is not OK to standard error and gives the exit code for it: 0 OK, 1 a file
// cannot be read or written, 2 anything else.
[[nodiscard]] int ReportStatus(const absl::Status& status);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_FILE_BYTES_H_
