// Joints, sparse weights and bone weights over the wire, both ways. (Dense weights, which come in
// blocks: chunk_conversion.h.)
#ifndef CAPFIT_PROTO_WIRE_SKINNING_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_SKINNING_CONVERSION_H_

#include <optional>

#include "absl/status/status.h"
#include "capfit/v1/result.pb.h"
#include "core/pipeline/fit.h"

namespace capfit::wire {

// The sparse or bone weights of a result in one block; nothing where it has neither.
[[nodiscard]] std::optional<v1::SkinningChunk> FewWeightsToWire(const pipeline::FitResult& result);

// The way back: fills `sparse_weights` or `bone_weights` of a result that has its primitives and
// joints. INVALID_ARGUMENT names what is out of range or does not fit together.
[[nodiscard]] absl::Status FewWeightsFromWire(const v1::SkinningChunk& wire,
                                              pipeline::FitResult& result);

// Joints, and which of them carries each sphere and capsule best. Spheres and capsules are there.
void JointsToWire(const pipeline::FitResult& result, v1::PrimitiveSet& wire);
[[nodiscard]] absl::Status JointsFromWire(const v1::PrimitiveSet& wire,
                                          pipeline::FitResult& result);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_SKINNING_CONVERSION_H_
