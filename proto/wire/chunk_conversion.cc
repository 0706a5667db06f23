#include "proto/wire/chunk_conversion.h"

#include <algorithm>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::wire {
namespace {

constexpr std::size_t kMaxMatrixRows = 10'000;
constexpr std::size_t kMaxMatrixColumns = 100'000'000;

// Where the next block must start, given how many weights there are already.
bool StartsAt(const v1::SkinningChunk& chunk, const skinning::DenseWeights& weights) {
  const std::size_t place = static_cast<std::size_t>(chunk.first_sphere()) * weights.vertex_count +
                            static_cast<std::size_t>(chunk.dense().first_vertex());
  return chunk.first_sphere() >= 0 && chunk.dense().first_vertex() >= 0 &&
         place == weights.weights.size();
}

}  // namespace

WeightBlock BlockAt(const skinning::DenseWeights& weights, std::size_t first_sphere,
                    std::size_t first_vertex, std::size_t max_weights) {
  if (first_sphere >= weights.sphere_count || weights.vertex_count == 0) return {};
  if (weights.vertex_count > max_weights) {
    return {first_sphere, 1, first_vertex,
            std::min(max_weights, weights.vertex_count - first_vertex)};
  }
  const std::size_t rows =
      std::min(max_weights / weights.vertex_count, weights.sphere_count - first_sphere);
  return {first_sphere, rows, 0, weights.vertex_count};
}

v1::SkinningChunk WeightsToWire(const skinning::DenseWeights& weights, const WeightBlock& block) {
  v1::SkinningChunk wire;
  wire.set_total_sphere_count(static_cast<int>(weights.sphere_count));
  wire.set_total_vertex_count(static_cast<std::int64_t>(weights.vertex_count));
  wire.set_first_sphere(static_cast<int>(block.first_sphere));
  wire.set_sphere_count(static_cast<int>(block.sphere_count));
  v1::DenseWeights& dense = *wire.mutable_dense();
  dense.set_first_vertex(static_cast<std::int64_t>(block.first_vertex));
  dense.set_vertex_count(static_cast<std::int64_t>(block.vertex_count));
  const float* const begin =
      weights.weights.data() + block.first_sphere * weights.vertex_count + block.first_vertex;
  dense.mutable_weights()->Add(begin, begin + block.sphere_count * block.vertex_count);
  return wire;
}

v1::VertexGapsChunk GapsToWire(std::span<const float> gaps, std::size_t first_vertex,
                               std::size_t max_gaps) {
  v1::VertexGapsChunk wire;
  wire.set_total_vertex_count(static_cast<std::int64_t>(gaps.size()));
  wire.set_first_vertex(static_cast<std::int64_t>(first_vertex));
  const std::span<const float> piece =
      gaps.subspan(first_vertex, std::min(max_gaps, gaps.size() - first_vertex));
  wire.mutable_gaps()->Add(piece.begin(), piece.end());
  return wire;
}

absl::Status AppendWeights(const v1::SkinningChunk& wire, skinning::DenseWeights& weights) {
  if (!wire.has_dense())
    return InvalidField(ErrorReason::kOutOfRange, "skinning.weights", "is of an unknown form");
  if (weights.weights.empty()) {
    weights.sphere_count = static_cast<std::size_t>(std::max(0, wire.total_sphere_count()));
    weights.vertex_count =
        static_cast<std::size_t>(std::max<std::int64_t>(0, wire.total_vertex_count()));
    if (weights.sphere_count > kMaxMatrixRows || weights.vertex_count > kMaxMatrixColumns) {
      return InvalidField(ErrorReason::kOutOfRange, "skinning.total_vertex_count",
                          "is beyond all reason");
    }
  }
  const auto count = static_cast<std::size_t>(wire.dense().weights_size());
  if (!StartsAt(wire, weights) ||
      weights.weights.size() + count > weights.sphere_count * weights.vertex_count) {
    return InvalidField(ErrorReason::kOutOfRange, "skinning",
                        absl::StrCat("block at sphere ", wire.first_sphere(),
                                     " does not follow the one before it"));
  }
  weights.weights.insert(weights.weights.end(), wire.dense().weights().begin(),
                         wire.dense().weights().end());
  return absl::OkStatus();
}

absl::Status AppendGaps(const v1::VertexGapsChunk& wire, std::vector<float>& gaps) {
  const std::int64_t count = wire.total_vertex_count();
  if (count < 1 || static_cast<std::uint64_t>(count) > kMaxMatrixColumns) {
    return InvalidField(ErrorReason::kOutOfRange, "vertex_gaps.total_vertex_count",
                        absl::StrCat("is ", count, ", must be in [1, ", kMaxMatrixColumns, "]"));
  }
  const auto added = static_cast<std::size_t>(wire.gaps_size());
  if (wire.first_vertex() != static_cast<std::int64_t>(gaps.size()) || added == 0 ||
      gaps.size() + added > static_cast<std::size_t>(count)) {
    return InvalidField(ErrorReason::kOutOfRange, "vertex_gaps",
                        absl::StrCat("piece of ", added, " at vertex ", wire.first_vertex(), " of ",
                                     count, " does not follow ", gaps.size()));
  }
  gaps.insert(gaps.end(), wire.gaps().begin(), wire.gaps().end());
  return absl::OkStatus();
}

}  // namespace capfit::wire
