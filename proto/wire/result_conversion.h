// The parts of a FitResult over the wire, both ways, without loss: doubles stay doubles.
#ifndef CAPFIT_PROTO_WIRE_RESULT_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_RESULT_CONVERSION_H_

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "capfit/v1/result.pb.h"
#include "capfit/v1/service.pb.h"
#include "core/pipeline/fit.h"

namespace capfit::wire {

// Text that any client can read: bytes that are not printable ASCII (a file's names may be any
// bytes, protobuf strings must be UTF-8) become '?', and what is longer than 1000 bytes is cut.
[[nodiscard]] std::string PlainText(const std::string& text);

[[nodiscard]] v1::Warning WarningToWire(const Warning& warning);
[[nodiscard]] v1::Landmarks LandmarksToWire(const pipeline::FitResult& result);
[[nodiscard]] v1::FeaturePolygon PolygonToWire(const pipeline::PolygonResult& polygon);
[[nodiscard]] v1::PrimitiveSet PrimitivesToWire(const pipeline::FitResult& result);
[[nodiscard]] v1::Summary SummaryToWire(const pipeline::FitResult& result,
                                        const std::string& request_id);

// All of it in one message, but for dense weights.
[[nodiscard]] v1::ApproximateBodyUnaryResponse ResultToWire(const pipeline::FitResult& result,
                                                            const std::string& request_id);

// Which block of a dense matrix: whole rows, or a piece of one row.
struct WeightBlock {
  std::size_t first_sphere = 0;
  std::size_t sphere_count = 0;
  std::size_t first_vertex = 0;
  std::size_t vertex_count = 0;
};
// The block that starts at this place and holds at most `max_weights` numbers; empty (sphere_count
// 0) behind the end. `first_vertex` is not 0 only within a row longer than `max_weights`.
[[nodiscard]] WeightBlock BlockAt(const skinning::DenseWeights& weights, std::size_t first_sphere,
                                  std::size_t first_vertex, std::size_t max_weights);
[[nodiscard]] v1::SkinningChunk WeightsToWire(const skinning::DenseWeights& weights,
                                              const WeightBlock& block);

// The vertices from `first_vertex` (below the size) on, at most `max_gaps` of them.
[[nodiscard]] v1::VertexGapsChunk GapsToWire(std::span<const float> gaps, std::size_t first_vertex,
                                             std::size_t max_gaps);

// The way back. What comes from a server is not trusted: INVALID_ARGUMENT for an unknown part, an
// index out of range, a block outside the matrix.
[[nodiscard]] Warning WarningFromWire(const v1::Warning& wire);
void LandmarksFromWire(const v1::Landmarks& wire, pipeline::FitResult& result);
[[nodiscard]] absl::StatusOr<pipeline::PolygonResult> PolygonFromWire(
    const v1::FeaturePolygon& wire);
// Fills `primitives`, `sphere_names`, `sphere_places` and what it knows of joints.
[[nodiscard]] absl::Status PrimitivesFromWire(const v1::PrimitiveSet& wire,
                                              pipeline::FitResult& result);
[[nodiscard]] absl::Status SummaryFromWire(const v1::Summary& wire, pipeline::FitResult& result);
// Appends the block, which must be the one that follows what `weights` holds already.
[[nodiscard]] absl::Status AppendWeights(const v1::SkinningChunk& wire,
                                         skinning::DenseWeights& weights);
// The same for a piece of the vertices' gaps.
[[nodiscard]] absl::Status AppendGaps(const v1::VertexGapsChunk& wire, std::vector<float>& gaps);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_RESULT_CONVERSION_H_
