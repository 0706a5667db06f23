#include "proto/wire/export_conversion.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::wire {

std::vector<pipeline::ExportWish> ExportsFromWire(
    const google::protobuf::RepeatedPtrField<v1::ExportRequest>& wire) {
  std::vector<pipeline::ExportWish> wishes;
  for (const v1::ExportRequest& request : wire) {
    pipeline::ExportWish& wish = wishes.emplace_back();
    wish.format = request.format();
    wish.options.has_preview = request.preview();
    wish.options.is_plain = request.plain();
    if (request.has_max_overshoot_m()) {
      wish.options.max_overshoot_m = request.max_overshoot_m();
    }
  }
  return wishes;
}

void ExportsToWire(const std::vector<pipeline::ExportWish>& wishes,
                   google::protobuf::RepeatedPtrField<v1::ExportRequest>& wire) {
  for (const pipeline::ExportWish& wish : wishes) {
    v1::ExportRequest& request = *wire.Add();
    request.set_format(wish.format);
    request.set_preview(wish.options.has_preview);
    request.set_plain(wish.options.is_plain);
    request.set_max_overshoot_m(wish.options.max_overshoot_m);
  }
}

v1::ExportChunk ExportToWire(const pipeline::ExportedFile& file, std::size_t first_byte,
                             std::size_t max_bytes) {
  v1::ExportChunk wire;
  wire.set_format(file.format);
  wire.set_name(file.file.name);
  wire.set_total_bytes(static_cast<std::int64_t>(file.file.bytes.size()));
  wire.set_first_byte(static_cast<std::int64_t>(first_byte));
  wire.set_data(file.file.bytes.substr(first_byte, max_bytes));
  return wire;
}

absl::Status AppendExport(const v1::ExportChunk& wire, std::vector<pipeline::ExportedFile>& files) {
  if (wire.first_byte() == 0) {
    files.push_back({wire.format(), {wire.name(), ""}});
  }
  const bool follows =
      !files.empty() && files.back().format == wire.format() &&
      files.back().file.name == wire.name() &&
      static_cast<std::int64_t>(files.back().file.bytes.size()) == wire.first_byte();
  if (!follows ||
      wire.first_byte() + static_cast<std::int64_t>(wire.data().size()) > wire.total_bytes()) {
    return InvalidField(
        ErrorReason::kOutOfOrder, "export_chunk.first_byte",
        absl::StrCat("is ", wire.first_byte(), ", which is not where ", wire.name(), " goes on"));
  }
  files.back().file.bytes += wire.data();
  return absl::OkStatus();
}

}  // namespace capfit::wire
