#include "client/batch_jobs.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <sstream>

#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "client/picture/file_bytes.h"
#include "core/base/status.h"
#include "core/base/version.h"
#include "core/formats/read_mesh.h"

namespace capfit::client {
namespace {

namespace fs = std::filesystem;

std::string KeyPath(const BatchJob& job) { return job.result + ".key"; }

void Add(const fs::path& body, const fs::path& below, const fs::path& output,
         std::vector<BatchJob>& jobs) {
  fs::path result = output / below;
  result += ".json";
  jobs.push_back({body.string(), result.string()});
}

absl::Status AddInput(const std::string& input, const fs::path& output,
                      std::vector<BatchJob>& jobs) {
  std::error_code problem;
  if (fs::is_regular_file(input, problem)) {
    Add(input, fs::path(input).filename(), output, jobs);
    return absl::OkStatus();
  }
  if (!fs::is_directory(input, problem)) {
    return absl::NotFoundError(absl::StrCat("no file or folder ", input));
  }
  fs::recursive_directory_iterator entries(input, problem);
  for (; !problem && entries != fs::recursive_directory_iterator(); entries.increment(problem)) {
    const fs::path path = entries->path();
    const bool is_mesh =
        formats::FormatFromFileName(path.string()) != formats::MeshFormat::kUnknown;
    if (is_mesh && entries->is_regular_file()) Add(path, fs::relative(path, input), output, jobs);
  }
  if (problem) {
    return absl::NotFoundError(absl::StrCat("cannot read ", input, ": ", problem.message()));
  }
  return absl::OkStatus();
}

absl::Status AddList(const std::string& list, const fs::path& output, std::vector<BatchJob>& jobs) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string text, ReadFileBytes(list));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) CAPFIT_RETURN_IF_ERROR(AddInput(line, output, jobs));
  }
  return absl::OkStatus();
}

absl::Status CheckDistinct(const std::vector<BatchJob>& jobs) {
  std::map<std::string, std::string> bodies;
  for (const BatchJob& job : jobs) {
    const auto [other, is_new] = bodies.try_emplace(job.result, job.body);
    if (!is_new) {
      return InvalidField(
          ErrorReason::kDuplicate, job.body,
          absl::StrCat("would give ", job.result, ", as ", other->second, " does; rename one"));
    }
  }
  return absl::OkStatus();
}

// A file that is there is whole.
absl::Status WriteWhole(const std::string& path, const std::string& bytes) {
  const std::string unfinished = path + ".tmp";
  CAPFIT_RETURN_IF_ERROR(WriteFileBytes(unfinished, bytes));
  std::error_code problem;
  fs::rename(unfinished, path, problem);
  if (!problem) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat("cannot write ", path, ": ", problem.message()));
}

}  // namespace

absl::StatusOr<std::vector<BatchJob>> FindJobs(const std::vector<std::string>& inputs,
                                               const std::string& list, const std::string& output) {
  std::vector<BatchJob> jobs;
  for (const std::string& input : inputs) CAPFIT_RETURN_IF_ERROR(AddInput(input, output, jobs));
  if (!list.empty()) CAPFIT_RETURN_IF_ERROR(AddList(list, output, jobs));
  if (jobs.empty()) return absl::NotFoundError("no mesh file is among what was named");
  std::sort(jobs.begin(), jobs.end(),
            [](const BatchJob& a, const BatchJob& b) { return a.body < b.body; });
  CAPFIT_RETURN_IF_ERROR(CheckDistinct(jobs));
  return jobs;
}

absl::StatusOr<std::vector<BatchJob>> ShareOf(std::vector<BatchJob> jobs,
                                              const std::string& share) {
  const std::size_t slash = share.find('/');
  int index = -1;
  int count = 0;
  const bool is_read = slash != std::string::npos &&
                       absl::SimpleAtoi(share.substr(0, slash), &index) &&
                       absl::SimpleAtoi(share.substr(slash + 1), &count);
  if (!is_read || index < 0 || index >= count) {
    return InvalidField(
        ErrorReason::kOutOfRange, "--share",
        absl::StrCat("is '", share, "', must be INDEX/COUNT with 0 <= INDEX < COUNT"));
  }
  std::vector<BatchJob> ours;
  for (auto i = static_cast<std::size_t>(index); i < jobs.size();
       i += static_cast<std::size_t>(count)) {
    ours.push_back(std::move(jobs[i]));
  }
  return ours;
}

std::string JobKey(std::string_view body_bytes, std::string_view options) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned int size = 0;
  EVP_MD_CTX* const context = EVP_MD_CTX_new();
  EVP_DigestInit_ex(context, EVP_sha256(), nullptr);
  // Lengths first, so that no two pairs run together to the same bytes.
  const std::string head = absl::StrCat(std::string(Version()), " ", options.size(), " ");
  for (const std::string_view piece : {std::string_view(head), options, body_bytes}) {
    EVP_DigestUpdate(context, piece.data(), piece.size());
  }
  EVP_DigestFinal_ex(context, hash.data(), &size);
  EVP_MD_CTX_free(context);
  return absl::BytesToHexString({reinterpret_cast<const char*>(hash.data()), size});
}

bool IsDone(const BatchJob& job, const std::string& key) {
  std::error_code ignored;
  if (!fs::is_regular_file(job.result, ignored)) return false;
  const absl::StatusOr<std::string> made_with = ReadFileBytes(KeyPath(job));
  return made_with.ok() && *made_with == key + "\n";
}

// The old key goes first and the new one comes last: between them no key vouches for a result.
absl::Status Finish(const BatchJob& job, const std::string& key, const std::string& result) {
  std::error_code ignored;
  fs::create_directories(fs::path(job.result).parent_path(), ignored);
  fs::remove(KeyPath(job), ignored);
  CAPFIT_RETURN_IF_ERROR(WriteWhole(job.result, result));
  return WriteWhole(KeyPath(job), key + "\n");
}

}  // namespace capfit::client
