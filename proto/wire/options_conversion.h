// FitOptions over the wire.
#ifndef CAPFIT_PROTO_WIRE_OPTIONS_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_OPTIONS_CONVERSION_H_

#include "absl/status/statusor.h"
#include "capfit/v1/service.pb.h"
#include "core/pipeline/fit.h"

namespace capfit::wire {

// The options of a header: `options`, `layout`, `exports`, and unit and axis from `mesh`. Ranges of
// numbers are not checked here but by pipeline::ValidateOptions. INVALID_ARGUMENT names the field
// ("options.landmarks[2].name"); UNIMPLEMENTED for weights of a form that capfit does not make.
[[nodiscard]] absl::StatusOr<pipeline::FitOptions> OptionsFromWire(
    const v1::ApproximateBodyHeader& header);

// The other way: sets `options` and the mesh's unit and axis; OptionsFromWire gives the same back.
void OptionsToWire(const pipeline::FitOptions& options, v1::ApproximateBodyHeader& header);

// An error of the core in the words of the request: the core knows landmarks by name, the request
// by place. Others stay as they are.
[[nodiscard]] absl::Status WithWirePaths(const absl::Status& status, const v1::FitOptions& options);

// What held in the end (FitResult::effective_options), both ways; the landmarks themselves are not
// sent back, and of a layout only its name.
[[nodiscard]] v1::EffectiveOptions EffectiveOptionsToWire(const pipeline::FitOptions& options);
[[nodiscard]] absl::StatusOr<pipeline::FitOptions> EffectiveOptionsFromWire(
    const v1::EffectiveOptions& wire);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_OPTIONS_CONVERSION_H_
