// The jobs of a catalogue: which body gives which file, and which are done already.
#ifndef CAPFIT_CLIENT_BATCH_JOBS_H_
#define CAPFIT_CLIENT_BATCH_JOBS_H_

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::client {

struct BatchJob {
  std::string body;    // path of a mesh file
  std::string result;  // path of its RESULT.json
};

// One job for each mesh file, in the order of their paths: `inputs` are files, and folders, which
// are searched to their depth; a result lies in `output` under the same name with ".json", below
// the same subfolders. `list` names a file with one path on each line, or is "". NOT_FOUND where a
// path is missing or no body is found; INVALID_ARGUMENT where two bodies would give one file.
[[nodiscard]] absl::StatusOr<std::vector<BatchJob>> FindJobs(const std::vector<std::string>& inputs,
                                                             const std::string& list,
                                                             const std::string& output);

// A share of the jobs: "2/5" is every fifth, from the third on. INVALID_ARGUMENT for other words.
[[nodiscard]] absl::StatusOr<std::vector<BatchJob>> ShareOf(std::vector<BatchJob> jobs,
                                                            const std::string& share);

// What a result depends on, in hexadecimal digits: the body's bytes, the options as they are sent,
// and this version.
[[nodiscard]] std::string JobKey(std::string_view body_bytes, std::string_view options);

// Whether the result is there and was made with this key.
[[nodiscard]] bool IsDone(const BatchJob& job, const std::string& key);

// Writes the result and its key (RESULT.json.key) so that a break at any moment leaves a result
// that IsDone knows, or none. NOT_FOUND where they cannot be written.
[[nodiscard]] absl::Status Finish(const BatchJob& job, const std::string& key,
                                  const std::string& result);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_BATCH_JOBS_H_
