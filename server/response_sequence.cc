#include "server/response_sequence.h"

#include <optional>
#include <utility>

#include "proto/wire/chunk_conversion.h"
#include "proto/wire/export_conversion.h"
#include "proto/wire/result_conversion.h"
#include "proto/wire/skinning_conversion.h"

namespace capfit::server {

bool ResponseSequence::Next(v1::ApproximateBodyResponse& response) {
  while (section_ != Section::kEnd) {
    response.Clear();
    if (Fill(response)) return true;
    section_ = static_cast<Section>(static_cast<int>(section_) + 1);
    index_ = 0;
  }
  return false;
}

bool ResponseSequence::Fill(v1::ApproximateBodyResponse& response) {
  switch (section_) {
    case Section::kWarnings:
      if (index_ >= result_.warnings.size()) return false;
      *response.mutable_warning() = wire::WarningToWire(result_.warnings[index_++]);
      return true;
    case Section::kLandmarks:
      if (index_++ > 0) return false;
      *response.mutable_landmarks() = wire::LandmarksToWire(result_);
      return true;
    case Section::kPolygons:
      if (index_ >= result_.polygons.size()) return false;
      *response.mutable_feature_polygon() = wire::PolygonToWire(result_.polygons[index_++]);
      return true;
    case Section::kPrimitives:
      if (index_++ > 0) return false;
      *response.mutable_primitives() = wire::PrimitivesToWire(result_);
      return true;
    case Section::kWeights:
      return FillWeights(response);
    case Section::kVertexGaps:
      return FillGaps(response);
    case Section::kExports:
      return FillExports(response);
    case Section::kSummary:
      if (index_++ > 0) return false;
      *response.mutable_summary() = wire::SummaryToWire(result_, request_id_);
      return true;
    case Section::kEnd:
      break;
  }
  return false;
}

bool ResponseSequence::FillWeights(v1::ApproximateBodyResponse& response) {
  if (!result_.weights) {
    if (index_++ > 0) return false;
    std::optional<v1::SkinningChunk> few = wire::FewWeightsToWire(result_);
    if (!few) return false;
    *response.mutable_skinning() = *std::move(few);
    return true;
  }
  const wire::WeightBlock block =
      wire::BlockAt(*result_.weights, index_, first_vertex_, max_weights_);
  if (block.sphere_count == 0) return false;
  *response.mutable_skinning() = wire::WeightsToWire(*result_.weights, block);
  first_vertex_ = block.first_vertex + block.vertex_count;
  if (first_vertex_ == result_.weights->vertex_count) {
    index_ += block.sphere_count;
    first_vertex_ = 0;
  }
  return true;
}

bool ResponseSequence::FillExports(v1::ApproximateBodyResponse& response) {
  if (index_ >= result_.exports.size()) return false;
  const pipeline::ExportedFile& file = result_.exports[index_];
  *response.mutable_export_chunk() =
      wire::ExportToWire(file, first_byte_, sizeof(float) * max_weights_);
  first_byte_ += response.export_chunk().data().size();
  if (first_byte_ < file.file.bytes.size()) return true;
  ++index_;
  first_byte_ = 0;
  return true;
}

bool ResponseSequence::FillGaps(v1::ApproximateBodyResponse& response) {
  if (index_ >= result_.vertex_gaps.size()) return false;
  v1::VertexGapsChunk& chunk = *response.mutable_vertex_gaps();
  chunk = wire::GapsToWire(result_.vertex_gaps, index_, max_weights_);
  index_ += static_cast<std::size_t>(chunk.gaps_size());
  return true;
}

}  // namespace capfit::server
