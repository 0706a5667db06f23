#include "proto/wire/unknown_fields.h"

#include <google/protobuf/unknown_field_set.h>

#include <set>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/version.h"

namespace capfit::wire {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

// What one warning lists; the count is of all.
constexpr std::size_t kMostListed = 10;

struct Finds {
  std::set<std::string> places;  // "field 20 of options"
  std::int64_t count = 0;
};

void Collect(const Message& message, const std::string& path, Finds& finds);

void CollectWithin(const Message& message, const FieldDescriptor& field, const std::string& path,
                   Finds& finds) {
  const Reflection& reflection = *message.GetReflection();
  if (!field.is_repeated()) {
    Collect(reflection.GetMessage(message, &field), path, finds);
    return;
  }
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    Collect(reflection.GetRepeatedMessage(message, &field, i), absl::StrCat(path, "[", i, "]"),
            finds);
  }
}

void Collect(const Message& message, const std::string& path, Finds& finds) {
  const Reflection& reflection = *message.GetReflection();
  const google::protobuf::UnknownFieldSet& unknown = reflection.GetUnknownFields(message);
  for (int i = 0; i < unknown.field_count(); ++i) {
    ++finds.count;
    if (finds.places.size() >= kMostListed) continue;
    finds.places.insert(absl::StrCat("field ", unknown.field(i).number(), " of ",
                                     path.empty() ? message.GetDescriptor()->name() : path));
  }
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* const field : fields) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    CollectWithin(message, *field, absl::StrCat(path, path.empty() ? "" : ".", field->name()),
                  finds);
  }
}

}  // namespace

std::optional<Warning> UnknownFieldsOf(const Message& message) {
  Finds finds;
  Collect(message, "", finds);
  if (finds.count == 0) return std::nullopt;
  return Warning{
      "UNKNOWN_FIELDS",
      absl::StrCat("version ", std::string(Version()), " does not know ",
                   absl::StrJoin(finds.places, ", "), "; what they ask for was not done"),
      finds.count};
}

}  // namespace capfit::wire
