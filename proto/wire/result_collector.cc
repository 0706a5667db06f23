#include "proto/wire/result_collector.h"

#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "proto/wire/chunk_conversion.h"
#include "proto/wire/enum_conversion.h"
#include "proto/wire/export_conversion.h"
#include "proto/wire/result_conversion.h"
#include "proto/wire/skinning_conversion.h"

namespace capfit::wire {
namespace {

using Response = v1::ApproximateBodyResponse;

absl::Status Broken(const std::string& problem) {
  return absl::InternalError(absl::StrCat("the server's answer breaks the contract: ", problem));
}

// Parts that come more than once.
bool MayRepeat(int part) {
  return part == Response::kProgress || part == Response::kWarning ||
         part == Response::kFeaturePolygon || part == Response::kSkinning ||
         part == Response::kVertexGaps || part == Response::kExportChunk;
}

// Where a part stands in the answer: by number, but for the summary, which is the last.
int PlaceOf(int part) {
  return part == Response::kSummary ? std::numeric_limits<int>::max() : part;
}

}  // namespace

absl::Status ResultCollector::Add(const v1::ApproximateBodyResponse& response) {
  const int part = response.part_case();
  if (part == Response::PART_NOT_SET) return absl::OkStatus();
  if (PlaceOf(part) < PlaceOf(last_part_) || (part == last_part_ && !MayRepeat(part))) {
    return Broken(absl::StrCat("part ", part, " after part ", last_part_));
  }
  last_part_ = part;
  const absl::Status status = AddPart(response);
  return status.ok() ? status : Broken(std::string(status.message()));
}

absl::Status ResultCollector::AddPart(const v1::ApproximateBodyResponse& response) {
  switch (response.part_case()) {
    case Response::kProgress: {
      const std::optional<Stage> stage = FromWire(response.progress().stage());
      if (stage && on_progress_) on_progress_(*stage, response.progress().fraction_done());
      return absl::OkStatus();
    }
    case Response::kWarning:
      result_.warnings.push_back(WarningFromWire(response.warning()));
      return absl::OkStatus();
    case Response::kLandmarks:
      LandmarksFromWire(response.landmarks(), result_);
      return absl::OkStatus();
    case Response::kFeaturePolygon: {
      CAPFIT_ASSIGN_OR_RETURN(pipeline::PolygonResult polygon,
                              PolygonFromWire(response.feature_polygon()));
      result_.polygons.push_back(std::move(polygon));
      return absl::OkStatus();
    }
    case Response::kPrimitives:
      return PrimitivesFromWire(response.primitives(), result_);
    case Response::kSkinning:
      if (!response.skinning().has_dense()) {
        return FewWeightsFromWire(response.skinning(), result_);
      }
      if (!result_.weights) result_.weights.emplace();
      return AppendWeights(response.skinning(), *result_.weights);
    case Response::kVertexGaps:
      vertex_count_ = response.vertex_gaps().total_vertex_count();
      return AppendGaps(response.vertex_gaps(), result_.vertex_gaps);
    case Response::kExportChunk:
      export_bytes_ = response.export_chunk().total_bytes();
      return AppendExport(response.export_chunk(), result_.exports);
    case Response::kSummary:
      return SummaryFromWire(response.summary(), result_);
    case Response::PART_NOT_SET:
      break;
  }
  return absl::OkStatus();
}

absl::StatusOr<pipeline::FitResult> ResultCollector::Finish() && {
  if (last_part_ != Response::kSummary) return Broken("it ends without a summary");
  if (result_.weights) {
    const skinning::DenseWeights& weights = *result_.weights;
    if (weights.weights.size() != weights.sphere_count * weights.vertex_count) {
      return Broken(absl::StrCat("it brings ", weights.weights.size(), " weights of ",
                                 weights.sphere_count * weights.vertex_count));
    }
  }
  if (static_cast<std::int64_t>(result_.vertex_gaps.size()) != vertex_count_) {
    return Broken(
        absl::StrCat("it brings ", result_.vertex_gaps.size(), " vertex gaps of ", vertex_count_));
  }
  if (!result_.exports.empty() &&
      static_cast<std::int64_t>(result_.exports.back().file.bytes.size()) != export_bytes_) {
    return Broken(absl::StrCat("it brings ", result_.exports.back().file.bytes.size(), " bytes of ",
                               export_bytes_, " of a file"));
  }
  return std::move(result_);
}

}  // namespace capfit::wire
