#include "server/fit_job.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/base/version.h"
#include "core/export/export.h"
#include "core/pipeline/colliders.h"
#include "proto/wire/enum_conversion.h"
#include "proto/wire/options_conversion.h"
#include "proto/wire/result_conversion.h"
#include "proto/wire/status_conversion.h"
#include "proto/wire/unknown_fields.h"
#include "server/caller.h"
#include "server/result_bytes.h"

namespace capfit::server {
namespace {

// Files of exports are named after the body's file, whose name the server is not told.
constexpr char kExportSource[] = "body";
constexpr char kPushbackTrailer[] = "grpc-retry-pushback-ms";
// A caller whose deadline passes ends the call itself, some milliseconds before it has passed here:
// the time that is left is sent rounded up, and is counted from its arrival.
constexpr std::chrono::milliseconds kDeadlineSlack{20};

using Clock = Watchdog::Clock;

// For the log: what makes one fit slower than another.
std::string WordsOf(const pipeline::FitOptions& options) {
  std::string words(pipeline::QualityName(options.quality));
  absl::StrAppend(&words, options.fit == pipeline::FitMode::kBestFit ? " best" : " enclose");
  const auto add = [&](const char* name, const auto& value) {
    if (value) absl::StrAppend(&words, " ", name, "=", *value);
  };
  add("max_primitives", options.max_primitives);
  add("max_spheres", options.max_spheres);
  add("max_capsules", options.max_capsules);
  add("polygon_error", options.polygon_error);
  if (!options.engine.empty()) absl::StrAppend(&words, " engine=", options.engine);
  if (options.layout) absl::StrAppend(&words, " layout");
  constexpr const char* kSkinning[] = {"", " dense", " sparse", " bones"};
  absl::StrAppend(&words, kSkinning[Index(options.skinning)]);
  for (const pipeline::ExportWish& wish : options.exports) {
    absl::StrAppend(&words, " export=", wish.format);
  }
  return words;
}

// The one that the refusal names.
int RetryMs(const absl::Status& status, int least_ms) {
  for (const auto& [name, value] : FactsOf(status)) {
    if (name == kRetryFact) return std::max(least_ms, std::atoi(value.c_str()));
  }
  return least_ms;
}

absl::Status CheckMessageSize(const google::protobuf::Message& request, const char* field) {
  const std::size_t bytes = request.ByteSizeLong();
  if (bytes <= static_cast<std::size_t>(kMaxMessageBytes)) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kTooLarge, field,
      absl::StrCat("comes in a message of ", bytes, " bytes, must have at most ", kMaxMessageBytes,
                   "; ApproximateBody takes larger meshes in chunks"),
      {{"value", absl::StrCat(bytes)}, {"limit", absl::StrCat(kMaxMessageBytes)}});
}

}  // namespace

FitJob::FitJob(const CallServices& services, grpc::CallbackServerContext& context,
               std::string token_name)
    : services_(services),
      context_(context),
      token_name_(std::move(token_name)),
      deadline_(context.deadline()),
      upload_(services.config.upload) {}

absl::Status FitJob::Admit() {
  record_.peer = context_.peer();
  record_.trace = TraceOf(context_);
  if (!record_.trace.empty()) context_.AddInitialMetadata(kTraceKey, record_.trace);
  record_.client = ClientOf(context_, token_name_);
  holding_.emplace(services_.admission, record_.client);
  CAPFIT_ASSIGN_OR_RETURN(record_.is_bulk, IsBulk(context_));
  return holding_->Open();
}

absl::Status FitJob::Add(const v1::ApproximateBodyRequest& request) {
  CAPFIT_RETURN_IF_ERROR(CheckMessageSize(request, request.has_chunk() ? "chunk" : "header"));
  NoteUnknownFields(request);
  const bool is_first = !upload_.has_header();
  CAPFIT_RETURN_IF_ERROR(InCallersWords(upload_.Add(request)));
  if (is_first) {
    CAPFIT_RETURN_IF_ERROR(ReadOptions());
    CAPFIT_RETURN_IF_ERROR(holding_->CheckClaim(upload_.claimed_bytes()));
  }
  return holding_->HoldBytes(upload_.held_bytes() +
                             static_cast<std::int64_t>(request.ByteSizeLong()));
}

absl::Status FitJob::Expect(const v1::ApproximateBodyUnaryRequest& request) {
  // Positions become doubles, so a mesh may take twice what it took in the message.
  request_bytes_ = static_cast<std::int64_t>(request.ByteSizeLong());
  const v1::InlineMesh& mesh = request.mesh();
  expected_faces_ = mesh.has_arrays() ? (mesh.arrays().face_sizes_size() > 0
                                             ? mesh.arrays().face_sizes_size()
                                             : mesh.arrays().triangle_indices_size() / 3)
                                      : request_bytes_ / kFileBytesOfAFace;
  // The rest of the options is read on the executor; the queue has to know this much.
  options_.quality = wire::FromWire(request.options().quality()).value_or(options_.quality);
  return holding_->HoldBytes(3 * request_bytes_);
}

absl::Status FitJob::AddWhole(const v1::ApproximateBodyUnaryRequest& request) {
  CAPFIT_RETURN_IF_ERROR(CheckMessageSize(request, "mesh"));
  NoteUnknownFields(request);
  CAPFIT_RETURN_IF_ERROR(InCallersWords(upload_.AddWhole(request)));
  CAPFIT_RETURN_IF_ERROR(ReadOptions());
  if (options_.skinning != pipeline::SkinningMode::kDense) return absl::OkStatus();
  return InCallersWords(InvalidField(
      ErrorReason::kConflict, "options.skinning",
      "is dense, which does not fit into one message; ApproximateBody streams the weights, sparse "
      "ones fit"));
}

FitSize FitJob::SizeOfFit() const {
  return {std::max(expected_faces_, upload_.face_count()), options_.quality,
          options_.skinning == pipeline::SkinningMode::kDense};
}

absl::Status FitJob::Enqueue(std::function<void()> run) {
  if (request_bytes_ == 0) {
    CAPFIT_RETURN_IF_ERROR(holding_->HoldBytes(
        upload_.held_bytes() +
        ExpectedResultBytes(options_, upload_.vertex_count(), upload_.held_bytes())));
  }
  const double seconds = services_.cost.ExpectedSeconds(SizeOfFit());
  WaitingFit fit{record_.client, record_.is_bulk, seconds};
  const double patience_seconds =
      std::chrono::duration<double>(deadline_ - std::chrono::system_clock::now()).count();
  CAPFIT_RETURN_IF_ERROR(
      holding_->CheckPatience(services_.executor.ExpectedWaitSeconds(fit), patience_seconds));
  CAPFIT_RETURN_IF_ERROR(holding_->BeginFit(seconds));
  queued_at_ = Clock::now();
  ticket_ = services_.executor.Submit(std::move(fit), std::move(run));
  return absl::OkStatus();
}

void FitJob::RunNowIfWaiting() {
  if (const std::function<void()> run = services_.executor.Withdraw(ticket_)) run();
}

absl::Status FitJob::ReadOptions() {
  absl::StatusOr<pipeline::FitOptions> options = wire::OptionsFromWire(upload_.header());
  if (!options.ok()) return InCallersWords(options.status());
  options_ = *std::move(options);
  record_.options = WordsOf(options_);
  CAPFIT_RETURN_IF_ERROR(InCallersWords(services_.backend.validate(options_)));
  return InCallersWords(CheckExports());
}

absl::Status FitJob::CheckExports() const {
  for (std::size_t i = 0; i < options_.exports.size(); ++i) {
    const std::string& format = options_.exports[i].format;
    if (!exports::FindExportFormat(format)->needs_original) continue;
    if (upload_.header().mesh().has_file()) continue;
    return InvalidField(
        ErrorReason::kConflict, absl::StrCat("exports[", i, "].format"),
        absl::StrCat("is ", format, ", for which the mesh must come as a file of that kind"));
  }
  return absl::OkStatus();
}

void FitJob::NoteUnknownFields(const google::protobuf::Message& request) {
  // One is enough: chunks of the same client have the same.
  if (!warnings_.empty()) return;
  if (std::optional<Warning> warning = wire::UnknownFieldsOf(request)) {
    warnings_.push_back(*std::move(warning));
  }
}

absl::Status FitJob::InCallersWords(const absl::Status& status) const {
  if (status.ok()) return status;
  std::vector<Warning> warnings = warnings_;
  for (Warning& warning : WarningsOf(status)) warnings.push_back(std::move(warning));
  const absl::Status renamed = upload_.InCallersWords(status);
  return WithWarnings(wire::WithWirePaths(renamed, upload_.header().options()), warnings);
}

absl::StatusOr<pipeline::FitResult> FitJob::Run(FitObserver& observer) {
  const SteadyTime begin = Clock::now();
  fit_deadline_ = Watchdog::After(services_.config.max_fit_seconds);
  record_.queued_seconds = std::chrono::duration<double>(begin - queued_at_).count();
  record_.faces = SizeOfFit().faces;
  absl::StatusOr<pipeline::FitResult> result = RunGuarded(observer);
  record_.fit_seconds = Watchdog::SecondsSince(begin);
  holding_->EndFit();
  upload_.DropFile();
  if (!result.ok()) return InCallersWords(result.status());
  if (record_.cached == Cached::kNo) {
    services_.cost.Learn(SizeOfFit(), record_.fit_seconds);
    record_.stage_seconds = result->stage_seconds;
  }
  holding_->HoldAnyway(request_bytes_ + ResultBytes(*result));
  result->warnings.insert(result->warnings.begin(), warnings_.begin(), warnings_.end());
  return result;
}

// The core throws nothing of its own; the libraries under it may, above all for want of memory.
// That must cost one call, not the server.
absl::StatusOr<pipeline::FitResult> FitJob::RunGuarded(FitObserver& observer) {
  try {
    return Compute(observer);
  } catch (const std::bad_alloc&) {
    return Refused(ErrorReason::kOutOfMemory, "not enough memory for this mesh on this server");
  } catch (const std::exception& error) {
    return Refused(ErrorReason::kInternal, absl::StrCat("the fit failed: ", error.what()));
  }
}

absl::StatusOr<pipeline::FitResult> FitJob::Compute(FitObserver& observer) {
  // A read that ends because the caller is gone looks like the end of the upload; only the context
  // knows already.
  if (IsOver() || context_.IsCancelled()) return GaveUp();
  // Of two uploads with the same bytes one may claim other counts: kept results are not for it.
  CAPFIT_RETURN_IF_ERROR(upload_.CheckComplete());
  const bool has_cache = services_.cache.is_on() || services_.shared_cache.is_on();
  if (!has_cache || WantsFreshFit(context_)) return Fit(observer);
  const std::string key = CacheKey();
  if (std::optional<pipeline::FitResult> kept = FindKept(key)) return *std::move(kept);
  absl::StatusOr<pipeline::FitResult> result = Fit(observer);
  if (!result.ok()) return result;
  services_.cache.Keep(key, *result);
  services_.shared_cache.Keep(key, *result);
  return result;
}

std::optional<pipeline::FitResult> FitJob::FindKept(const std::string& key) {
  if (const ResultCache::Result kept = services_.cache.Find(key)) {
    record_.cached = Cached::kMemory;
    return *kept;
  }
  std::optional<pipeline::FitResult> kept = services_.shared_cache.Find(key);
  if (!kept) return std::nullopt;
  record_.cached = Cached::kRedis;
  services_.cache.Keep(key, *kept);
  return kept;
}

std::string FitJob::CacheKey() const {
  ContentHash hash;
  hash.Add(std::string(Version()));
  upload_.AddTo(hash);
  return hash.Finish();
}

absl::StatusOr<pipeline::FitResult> FitJob::Fit(FitObserver& observer) {
  CAPFIT_RETURN_IF_ERROR(pipeline::CheckExports(options_.exports, upload_.file()));
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, std::move(upload_).Finish());
  record_.faces = static_cast<std::int64_t>(soup.face_count());
  absl::StatusOr<pipeline::FitResult> result =
      services_.backend.fit(soup, options_, services_.pool, observer);
  if (absl::IsCancelled(result.status())) return GaveUp();
  if (!result.ok()) return result;
  CAPFIT_RETURN_IF_ERROR(
      pipeline::AddExports(options_.exports, upload_.file(), kExportSource, *result));
  return result;
}

void FitJob::Stop(StopCause cause) {
  StopCause none = StopCause::kNone;
  cause_.compare_exchange_strong(none, cause);
}

bool FitJob::IsOver() const {
  const SteadyTime now = Clock::now();
  return is_stopped() || now >= fit_deadline_.load() || now >= services_.stop_at.load() ||
         std::chrono::system_clock::now() >= deadline_;
}

absl::Status FitJob::GaveUp() const {
  const SteadyTime now = Clock::now();
  if (cause_ == StopCause::kReader) {
    return Refused(ErrorReason::kReaderTooSlow,
                   absl::StrCat("the caller read nothing of its answer for ",
                                services_.config.read_idle_seconds, " s"));
  }
  if (now >= services_.stop_at.load()) {
    return Refused(ErrorReason::kServerStopping,
                   absl::StrCat("this server stops, and the call did not end within the ",
                                services_.config.drain_seconds, " s that it had"));
  }
  if (std::chrono::system_clock::now() + kDeadlineSlack >= deadline_) {
    return Refused(ErrorReason::kDeadlineExceeded, "the caller's deadline passed during the fit");
  }
  if (now >= fit_deadline_.load()) {
    return Refused(ErrorReason::kFitTooLong,
                   absl::StrCat("the fit took more than the ", services_.config.max_fit_seconds,
                                " s that this server allows"));
  }
  return Refused(ErrorReason::kCancelled, "the caller gave up");
}

grpc::Status FitJob::Answer(const absl::Status& status) {
  if (!absl::IsResourceExhausted(status)) return wire::ToGrpcStatus(status);
  const int wait_ms = RetryMs(status, services_.config.retry_pushback_ms);
  context_.AddTrailingMetadata(kPushbackTrailer, std::to_string(wait_ms));
  return wire::ToGrpcStatus(status, wait_ms);
}

void FitJob::Close(const char* method, const absl::Status& status) {
  record_.method = method;
  record_.request_id = request_id();
  record_.received_bytes = upload_.received_bytes();
  record_.seconds = Watchdog::SecondsSince(begin_);
  record_.status = status;
  spdlog::info("{}", CallLine(record_, services_.config.log_format));
  services_.metrics.Count(record_);
}

}  // namespace capfit::server
