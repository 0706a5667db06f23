// Places and layouts over the wire.
#ifndef CAPFIT_PROTO_WIRE_LAYOUT_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_LAYOUT_CONVERSION_H_

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "capfit/v1/service.pb.h"
#include "core/refine/layouts/kept_layout.h"

namespace capfit::wire {

[[nodiscard]] v1::BodyPlace PlaceToWire(const refine::BodyPlace& place);
// INVALID_ARGUMENT naming `field` for a bone that is none.
[[nodiscard]] absl::StatusOr<refine::BodyPlace> PlaceFromWire(const v1::BodyPlace& wire,
                                                              const std::string& field);

// INVALID_ARGUMENT for an unknown name ("layout.name"), an enum number that is none, or where
// neither is set. Numbers are not checked here but by refine::CheckLayout.
[[nodiscard]] absl::StatusOr<refine::KeptLayout> LayoutFromWire(const v1::Layout& wire);

// A standard layout by its name, others as the set that they are. LayoutFromWire gives the same
// back.
[[nodiscard]] v1::Layout LayoutToWire(const refine::KeptLayout& layout);

// An error of refine::CheckLayout in the words of the request; others stay as they are.
[[nodiscard]] absl::Status WithLayoutPaths(const absl::Status& status);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_LAYOUT_CONVERSION_H_
