// Puts the messages of an answer together to one result, and holds the server to the contract.
#ifndef CAPFIT_PROTO_WIRE_RESULT_COLLECTOR_H_
#define CAPFIT_PROTO_WIRE_RESULT_COLLECTOR_H_

#include <cstdint>
#include <functional>

#include "absl/status/statusor.h"
#include "capfit/v1/service.pb.h"
#include "core/pipeline/fit.h"

namespace capfit::wire {

// Use: Add() each message in order, then Finish(). Errors are INTERNAL: out of order, twice,
// missing or malformed. Parts of a later version of the contract are ignored.
class ResultCollector {
 public:
  explicit ResultCollector(std::function<void(Stage, double)> on_progress)
      : on_progress_(std::move(on_progress)) {}

  [[nodiscard]] absl::Status Add(const v1::ApproximateBodyResponse& response);
  [[nodiscard]] absl::StatusOr<pipeline::FitResult> Finish() &&;

 private:
  [[nodiscard]] absl::Status AddPart(const v1::ApproximateBodyResponse& response);

  std::function<void(Stage, double)> on_progress_;
  pipeline::FitResult result_;
  int last_part_ = 0;
  std::int64_t vertex_count_ = 0;  // that the vertex gaps announce
  std::int64_t export_bytes_ = 0;  // of the file whose pieces come
};

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_RESULT_COLLECTOR_H_
