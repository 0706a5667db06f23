// Files for engines over the wire.
#ifndef CAPFIT_PROTO_WIRE_EXPORT_CONVERSION_H_
#define CAPFIT_PROTO_WIRE_EXPORT_CONVERSION_H_

#include <google/protobuf/repeated_ptr_field.h>

#include <cstddef>
#include <vector>

#include "absl/status/status.h"
#include "capfit/v1/service.pb.h"
#include "core/pipeline/fit.h"

namespace capfit::wire {

// What was asked for, both ways. Names and ranges are checked by pipeline::ValidateOptions.
[[nodiscard]] std::vector<pipeline::ExportWish> ExportsFromWire(
    const google::protobuf::RepeatedPtrField<v1::ExportRequest>& wire);
void ExportsToWire(const std::vector<pipeline::ExportWish>& wishes,
                   google::protobuf::RepeatedPtrField<v1::ExportRequest>& wire);

// A piece of at most `max_bytes` of a file, from `first_byte` (at most its size) on.
[[nodiscard]] v1::ExportChunk ExportToWire(const pipeline::ExportedFile& file,
                                           std::size_t first_byte, std::size_t max_bytes);
// Appends the piece, which must be the next of the last file, or the first of another.
// INVALID_ARGUMENT where it is neither.
[[nodiscard]] absl::Status AppendExport(const v1::ExportChunk& wire,
                                        std::vector<pipeline::ExportedFile>& files);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_EXPORT_CONVERSION_H_
