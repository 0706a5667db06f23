// Whole files in and out; "-" is standard input and standard output.
#ifndef CAPFIT_CLIENT_PICTURE_FILE_BYTES_H_
#define CAPFIT_CLIENT_PICTURE_FILE_BYTES_H_

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace capfit::client {

// NOT_FOUND with the name where the file cannot be read, also for a second "-": standard input can
// be read once.
[[nodiscard]] absl::StatusOr<std::string> ReadFileBytes(const std::string& path);

// NOT_FOUND with the name where the file cannot be written.
[[nodiscard]] absl::Status WriteFileBytes(const std::string& path, const std::string& bytes);

// Whether WriteFileBytes will be able to, asked before hours of work are done for nothing: a file
// that is there is opened and left as it is, one that is not is made and removed again. NOT_FOUND
// with the name and what the system says.
[[nodiscard]] absl::Status CheckWritable(const std::string& path);

// The ending of a file name in small letters, with its dot: ".png"; "" where it has none.
[[nodiscard]] std::string FileEnding(const std::string& path);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_FILE_BYTES_H_
