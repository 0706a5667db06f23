// The parts of a FitResult over the wire, both ways, without loss: doubles stay doubles.
#ifndef CAPFIT_PROTO_WIRE_RESULT_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_RESULT_CONVERSION_H_

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "capfit/v1/result.pb.h"
#include "capfit/v1/service.pb.h"
#include "core/pipeline/fit.h"

namespace capfit::wire {

[[nodiscard]] v1::Warning WarningToWire(const Warning& warning);
[[nodiscard]] v1::Landmarks LandmarksToWire(const pipeline::FitResult& result);
[[nodiscard]] v1::FeaturePolygon PolygonToWire(const pipeline::PolygonResult& polygon);
[[nodiscard]] v1::PrimitiveSet PrimitivesToWire(const pipeline::FitResult& result);
[[nodiscard]] v1::Summary SummaryToWire(const pipeline::FitResult& result,
                                        const std::string& request_id);

// All of it in one message, but for dense weights.
[[nodiscard]] v1::ApproximateBodyUnaryResponse ResultToWire(const pipeline::FitResult& result,
                                                            const std::string& request_id);

// The way back. What comes from a server is not trusted: INVALID_ARGUMENT for an unknown part or an
// index out of range.
[[nodiscard]] Warning WarningFromWire(const v1::Warning& wire);
void LandmarksFromWire(const v1::Landmarks& wire, pipeline::FitResult& result);
[[nodiscard]] absl::StatusOr<pipeline::PolygonResult> PolygonFromWire(
    const v1::FeaturePolygon& wire);
// Fills `primitives`, `sphere_names`, `sphere_places` and what it knows of joints.
[[nodiscard]] absl::Status PrimitivesFromWire(const v1::PrimitiveSet& wire,
                                              pipeline::FitResult& result);
[[nodiscard]] absl::Status SummaryFromWire(const v1::Summary& wire, pipeline::FitResult& result);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_RESULT_CONVERSION_H_
