// What is too large for one message, in chunks: dense weights and the vertices' gaps, both ways.
#ifndef CAPFIT_PROTO_WIRE_CHUNK_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_CHUNK_CONVERSION_H_

#include <cstddef>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "capfit/v1/service.pb.h"
#include "core/skinning/mean_value_coordinates.h"

namespace capfit::wire {

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

// The way back. What comes from a server is not trusted: INVALID_ARGUMENT for a block outside the
// matrix.
// Appends the block, which must be the one that follows what `weights` holds already.
[[nodiscard]] absl::Status AppendWeights(const v1::SkinningChunk& wire,
                                         skinning::DenseWeights& weights);
// The same for a piece of the vertices' gaps.
[[nodiscard]] absl::Status AppendGaps(const v1::VertexGapsChunk& wire, std::vector<float>& gaps);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_CHUNK_CONVERSION_H_
