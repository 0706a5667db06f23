#include "client/batch_command.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/approximate_flags.h"
#include "client/batch_jobs.h"
#include "client/exit_code.h"
#include "client/picture/file_bytes.h"
#include "client/progress_line.h"
#include "client/result_json.h"
#include "client/server_flags.h"
#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "proto/wire/options_conversion.h"

namespace capfit::client {
namespace {

struct BatchArguments {
  std::vector<std::string> inputs;
  std::string list;
  std::string output;
  std::string share = "0/1";
  int parallel = 4;
  int max_attempts = 20;
  double timeout_seconds = 600.0;
  bool quiet = false;
  FitFlags fit;
  ServerFlags server;
};

struct Failure {
  std::string body;
  absl::Status status;
};

// What has come of the jobs so far; safe from several threads at once.
class BatchState {
 public:
  BatchState(std::size_t total, bool quiet) : total_(total), quiet_(quiet) {}

  void Add(const BatchJob& job, const absl::StatusOr<bool>& was_made) {
    const std::lock_guard lock(mutex_);
    if (!was_made.ok()) {
      failures_.push_back({job.body, was_made.status()});
    } else {
      ++(*was_made ? made_ : there_);
    }
    Show();
  }

  // The table of failures, then the sum; the worst exit code of all.
  int Report() {
    if (!quiet_ && StderrIsTerminal()) std::fputs("\r\x1b[K", stderr);
    int exit_code = kExitDone;
    for (const Failure& failure : failures_) {
      std::fprintf(stderr, "capfit: %s: %s: %s\n", failure.body.c_str(),
                   absl::StatusCodeToString(failure.status.code()).c_str(),
                   std::string(failure.status.message()).c_str());
      exit_code = std::max(exit_code, ExitCodeOf(failure.status));
    }
    if (!quiet_) std::printf("%s\n", Sum().c_str());
    return exit_code;
  }

 private:
  std::string Sum() const {
    return absl::StrCat(made_ + there_ + failures_.size(), " of ", total_, " bodies: ", made_,
                        " fitted, ", there_, " there already, ", failures_.size(), " failed");
  }
  void Show() const {
    if (!quiet_ && StderrIsTerminal()) std::fprintf(stderr, "\r\x1b[K%s", Sum().c_str());
  }

  const std::size_t total_;
  const bool quiet_;
  std::mutex mutex_;
  std::size_t made_ = 0;
  std::size_t there_ = 0;
  std::vector<Failure> failures_;
};

// All workers share it; it does not change.
struct BatchWork {
  BodyClient client;
  pipeline::FitOptions options;
  std::string options_key;
  CallOptions call;
};

// Whether the result was made now; false: it was there.
absl::StatusOr<bool> Make(const BatchJob& job, const BatchWork& work) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string bytes, ReadFileBytes(job.body));
  const std::string key = JobKey(bytes, work.options_key);
  if (IsDone(job, key)) return false;
  CAPFIT_ASSIGN_OR_RETURN(
      const pipeline::FitResult result,
      work.client.ApproximateFile(std::as_bytes(std::span(bytes)),
                                  formats::FormatFromFileName(job.body), work.options, work.call));
  CAPFIT_RETURN_IF_ERROR(Finish(job, key, FormatResult(result)));
  return true;
}

std::string OptionsKey(const pipeline::FitOptions& options) {
  v1::ApproximateBodyHeader header;
  wire::OptionsToWire(options, header);
  return header.SerializeAsString();
}

absl::Status CheckBatchOptions(const pipeline::FitOptions& options) {
  CAPFIT_RETURN_IF_ERROR(pipeline::ValidateOptions(options));
  if (options.skinning != pipeline::SkinningMode::kDense) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kConflict, "--skinning",
      "is dense, whose weights are a file beside RESULT.json; batch writes RESULT.json "
      "files alone");
}

absl::StatusOr<BatchWork> WorkOf(const BatchArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(pipeline::FitOptions options, OptionsOf(arguments.fit));
  CAPFIT_RETURN_IF_ERROR(CheckBatchOptions(options));
  CAPFIT_ASSIGN_OR_RETURN(BodyClient client, ConnectTo(arguments.server));
  CallOptions call;
  call.timeout_seconds = arguments.timeout_seconds;
  call.max_attempts = arguments.max_attempts;
  call.is_bulk = true;
  std::string key = OptionsKey(options);
  return BatchWork{std::move(client), std::move(options), std::move(key), std::move(call)};
}

absl::StatusOr<int> RunBatch(const BatchArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(std::vector<BatchJob> all,
                          FindJobs(arguments.inputs, arguments.list, arguments.output));
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<BatchJob> jobs,
                          ShareOf(std::move(all), arguments.share));
  CAPFIT_ASSIGN_OR_RETURN(const BatchWork work, WorkOf(arguments));
  BatchState state(jobs.size(), arguments.quiet);
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> workers;
  for (int i = 0; i < arguments.parallel; ++i) {
    workers.emplace_back([&] {
      for (std::size_t k = next++; k < jobs.size(); k = next++)
        state.Add(jobs[k], Make(jobs[k], work));
    });
  }
  for (std::thread& worker : workers) worker.join();
  return state.Report();
}

void AddBatchFlags(CLI::App& command, BatchArguments& arguments) {
  command.add_option("BODIES", arguments.inputs, "Mesh files, and folders of them")
      ->type_name("PATH")
      ->group("Input");
  command.add_option("--list", arguments.list, "File with one path on each line")
      ->type_name("FILE")
      ->group("Input");
  command
      .add_option("--share", arguments.share,
                  "INDEX/COUNT: only every COUNT-th body, from INDEX on, counted from 0")
      ->capture_default_str()
      ->group("Input");
  command.add_option("-o,--output", arguments.output, "Folder for the results: NAME.obj.json")
      ->required()
      ->type_name("FOLDER")
      ->group("Output");
  command.add_flag("--quiet", arguments.quiet, "Print failures only")->group("Output");
  command.add_option("--parallel", arguments.parallel, "Calls at a time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->group("Server");
  command
      .add_option("--attempts", arguments.max_attempts,
                  "Attempts of a call that is refused or breaks")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->group("Server");
  AddTimeoutFlag(command, arguments.timeout_seconds,
                 "Seconds that one body may take with all attempts")
      ->group("Server");
}

}  // namespace

void AddBatchCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<BatchArguments>();
  CLI::App* const command =
      app.add_subcommand("batch", "Fit a whole catalogue of bodies by one server or several");
  AddBatchFlags(*command, *arguments);
  AddServerFlags(*command, arguments->server);
  AddFitFlags(*command, arguments->fit);
  // These have their own files beside RESULT.json.
  for (const char* const flag : {"--export", "--heat-map"}) {
    command->remove_option(command->get_option(flag));
  }
  command->footer(
      "A result that is there and was made of the same bytes, options and version is left as it "
      "is, so that a batch that was broken off goes on. Exit code: the worst of all bodies.");
  command->callback([arguments, &exit_code] {
    const absl::StatusOr<int> worst = RunBatch(*arguments);
    exit_code = worst.ok() ? *worst : Report(worst.status());
  });
}

}  // namespace capfit::client
