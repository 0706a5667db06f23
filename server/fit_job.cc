#include "server/fit_job.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <new>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/export.h"
#include "core/pipeline/colliders.h"
#include "proto/wire/options_conversion.h"
#include "proto/wire/result_conversion.h"
#include "proto/wire/status_conversion.h"
#include "proto/wire/unknown_fields.h"

namespace capfit::server {
namespace {

// Files of exports are named after the body's file, whose name the server is not told.
constexpr char kExportSource[] = "body";
constexpr char kPushbackTrailer[] = "grpc-retry-pushback-ms";

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

FitJob::FitJob(const CallServices& services, grpc::CallbackServerContext& context)
    : services_(services),
      context_(context),
      deadline_(context.deadline()),
      upload_(services.config.upload) {}

absl::Status FitJob::Admit() {
  place_ = services_.executor.TryTakePlace();
  if (place_ != nullptr) return absl::OkStatus();
  const ServerConfig& config = services_.config;
  return Refused(ErrorReason::kServerFull,
                 absl::StrCat("all ", config.max_concurrent_fits + config.max_queued_fits,
                              " places of this server are taken, try again in ",
                              config.retry_pushback_ms, " ms or ask another replica"));
}

absl::Status FitJob::Add(const v1::ApproximateBodyRequest& request) {
  CAPFIT_RETURN_IF_ERROR(CheckMessageSize(request, request.has_chunk() ? "chunk" : "header"));
  NoteUnknownFields(request);
  const bool is_first = !upload_.has_header();
  CAPFIT_RETURN_IF_ERROR(InCallersWords(upload_.Add(request)));
  return is_first ? ReadOptions() : absl::OkStatus();
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

absl::Status FitJob::ReadOptions() {
  absl::StatusOr<pipeline::FitOptions> options = wire::OptionsFromWire(upload_.header());
  if (!options.ok()) return InCallersWords(options.status());
  options_ = *std::move(options);
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

// The core throws nothing of its own; the libraries under it may, above all for want of memory.
// That must cost one call, not the server.
absl::StatusOr<pipeline::FitResult> FitJob::Run(FitObserver& observer) {
  absl::StatusOr<pipeline::FitResult> result;
  try {
    result = Compute(observer);
  } catch (const std::bad_alloc&) {
    result = Refused(ErrorReason::kOutOfMemory, "not enough memory for this mesh on this server");
  } catch (const std::exception& error) {
    result = Refused(ErrorReason::kInternal, absl::StrCat("the fit failed: ", error.what()));
  }
  if (!result.ok()) return InCallersWords(result.status());
  result->warnings.insert(result->warnings.begin(), warnings_.begin(), warnings_.end());
  return result;
}

absl::StatusOr<pipeline::FitResult> FitJob::Compute(FitObserver& observer) {
  // A read that ends because the caller is gone looks like the end of the upload; only the context
  // knows already.
  if (IsOver() || context_.IsCancelled()) return GaveUp();
  CAPFIT_ASSIGN_OR_RETURN(const formats::PolygonSoup soup, std::move(upload_).Finish());
  absl::StatusOr<pipeline::FitResult> result =
      services_.backend.fit(soup, options_, services_.pool, observer);
  if (absl::IsCancelled(result.status())) return GaveUp();
  if (!result.ok()) return result;
  CAPFIT_RETURN_IF_ERROR(
      pipeline::AddExports(options_.exports, upload_.file(), kExportSource, *result));
  return result;
}

bool FitJob::IsOver() const {
  return is_cancelled() || std::chrono::system_clock::now() >= deadline_;
}

absl::Status FitJob::GaveUp() const {
  if (std::chrono::system_clock::now() >= deadline_) {
    return Refused(ErrorReason::kDeadlineExceeded, "the caller's deadline passed during the fit");
  }
  return Refused(ErrorReason::kCancelled, "the caller gave up");
}

grpc::Status FitJob::Close(const char* method, const absl::Status& status) {
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  spdlog::info("{} id={} peer={} bytes={} seconds={:.3f} status={}", method,
               wire::PlainText(request_id()), context_.peer(), upload_.received_bytes(), seconds,
               status.ok() ? "OK"
                           : wire::PlainText(absl::StrCat(absl::StatusCodeToString(status.code()),
                                                          ": ", status.message())));
  if (!absl::IsResourceExhausted(status)) return wire::ToGrpcStatus(status);
  const int wait_ms = services_.config.retry_pushback_ms;
  context_.AddTrailingMetadata(kPushbackTrailer, std::to_string(wait_ms));
  return wire::ToGrpcStatus(status, wait_ms);
}

}  // namespace capfit::server
