// docs/result.schema.json against the contract: the same names, the same words. (Real results are
// held against the schema in tests/e2e/result_schema_test.cc.)
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "capfit/v1/result.pb.h"
#include "client/message_json.h"
#include "client/picture/file_bytes.h"
#include "client/result_json.h"

namespace capfit::client {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using nlohmann::ordered_json;

ordered_json Schema() { return ordered_json::parse(*ReadFileBytes(CAPFIT_RESULT_SCHEMA)); }

ordered_json WordsOf(const EnumDescriptor& type) {
  ordered_json words = ordered_json::array();
  for (int i = 1; i < type.value_count(); ++i) words.push_back(EnumWord(*type.value(i)));
  return words;
}

// The words of an enum's member, null left out.
ordered_json Listed(const ordered_json& member) {
  ordered_json words = ordered_json::array();
  for (const ordered_json& word :
       member.contains("items") ? member["items"]["enum"] : member["enum"]) {
    if (!word.is_null()) words.push_back(word);
  }
  return words;
}

void ExpectAlike(const ordered_json& schema, const Descriptor& message,
                 const std::set<std::string>& elsewhere = {}) {
  std::set<std::string> names;
  for (const auto& [name, member] : schema["properties"].items()) names.insert(name);
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor& field = *message.field(i);
    if (elsewhere.contains(field.name())) continue;
    EXPECT_EQ(names.erase(field.name()), 1U) << message.name() << "." << field.name();
    if (field.enum_type() == nullptr) continue;
    EXPECT_EQ(Listed(schema["properties"][field.name()]), WordsOf(*field.enum_type()))
        << field.name();
  }
  EXPECT_TRUE(names.empty()) << "not in " << message.name() << ": " << *names.begin();
}

TEST(ResultSchema, ObjectsHaveTheMembersAndWordsOfTheContract) {
  const ordered_json schema = Schema();
  const ordered_json& root = schema["properties"];
  ExpectAlike(root["options"], *v1::EffectiveOptions::descriptor());
  ExpectAlike(root["options"]["properties"]["budget"], *v1::EffectiveBudget::descriptor());
  ExpectAlike(root["body"], *v1::BodyFacts::descriptor());
  ExpectAlike(root["body_from_caller"], *v1::Similarity::descriptor());
  ExpectAlike(root["metrics"], *v1::Metrics::descriptor());
  ExpectAlike(schema["$defs"]["gap"], *v1::GapStatistics::descriptor());
  ExpectAlike(schema["$defs"]["part_metrics"], *v1::PartMetrics::descriptor(), {"part"});
  ExpectAlike(root["landmarks"]["additionalProperties"], *v1::Landmark::descriptor(), {"name"});
  ExpectAlike(root["warnings"]["items"], *v1::Warning::descriptor());
}

TEST(ResultSchema, ListsOfWordsAreThoseOfTheContract) {
  const ordered_json schema = Schema();
  const ordered_json& root = schema["properties"];
  const auto names = [](const ordered_json& object) {
    ordered_json list = ordered_json::array();
    for (const auto& [name, member] : object["properties"].items()) list.push_back(name);
    return list;
  };
  EXPECT_EQ(Listed(schema["$defs"]["body_part"]), WordsOf(*v1::BodyPart_descriptor()));
  EXPECT_EQ(names(root["metrics"]["properties"]["parts"]), WordsOf(*v1::BodyPart_descriptor()));
  EXPECT_EQ(names(root["stages"]), WordsOf(*v1::Stage_descriptor()));
  EXPECT_EQ(Listed(root["unit"]), WordsOf(*v1::LengthUnit_descriptor()));
  EXPECT_EQ(Listed(root["up_axis"]), WordsOf(*v1::UpAxis_descriptor()));
}

TEST(ResultSchema, DescribesTheFormatThatIsWritten) {
  const ordered_json schema = Schema();
  const auto result = ordered_json::parse(FormatResult({}, "job"));
  EXPECT_EQ(schema["properties"]["format_version"]["const"], kResultFormatVersion);
  for (const auto& [name, member] : result.items()) {
    EXPECT_TRUE(schema["properties"].contains(name)) << name;
  }
}

}  // namespace
}  // namespace capfit::client
