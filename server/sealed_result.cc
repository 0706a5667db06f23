#include "server/sealed_result.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/delimited_message_util.h>

#include <utility>

#include "proto/wire/result_collector.h"
#include "server/content_hash.h"
#include "server/response_sequence.h"

namespace capfit::server {
namespace {

using google::protobuf::io::ArrayInputStream;
using google::protobuf::io::CodedOutputStream;
using google::protobuf::io::StringOutputStream;

constexpr std::size_t kHashBytes = 32;
// Changes with the form of what follows the hash.
constexpr char kForm[] = "messages of ApproximateBody, delimited";

std::string HashOf(const std::string& messages, const std::string& key, const std::string& secret) {
  ContentHash hash;
  hash.Add(secret);
  hash.Add(std::string(kForm));
  hash.Add(key);
  hash.Add(messages);
  return hash.Finish();
}

std::string MessagesOf(pipeline::FitResult result) {
  ResponseSequence sequence(std::move(result), "");
  std::string messages;
  {
    StringOutputStream out(&messages);
    CodedOutputStream coded(&out);
    coded.SetSerializationDeterministic(true);
    v1::ApproximateBodyResponse response;
    while (sequence.Next(response)) {
      google::protobuf::util::SerializeDelimitedToCodedStream(response, &coded);
    }
  }
  return messages;
}

std::optional<pipeline::FitResult> ResultOf(const char* messages, std::size_t bytes) {
  ArrayInputStream in(messages, static_cast<int>(bytes));
  wire::ResultCollector collector({});
  bool is_at_end = false;
  for (;;) {
    v1::ApproximateBodyResponse response;
    if (!google::protobuf::util::ParseDelimitedFromZeroCopyStream(&response, &in, &is_at_end)) {
      break;
    }
    if (!collector.Add(response).ok()) return std::nullopt;
  }
  absl::StatusOr<pipeline::FitResult> result = std::move(collector).Finish();
  if (!is_at_end || !result.ok()) return std::nullopt;
  return *std::move(result);
}

}  // namespace

std::optional<std::string> Seal(const pipeline::FitResult& result, const std::string& key,
                                const std::string& secret) {
  std::string messages = MessagesOf(result);
  // What a later version adds to a result and forgets on this way must not get lost silently.
  std::optional<pipeline::FitResult> back = ResultOf(messages.data(), messages.size());
  if (!back || MessagesOf(*std::move(back)) != messages) return std::nullopt;
  return HashOf(messages, key, secret) + messages;
}

std::optional<pipeline::FitResult> Unseal(const std::string& sealed, const std::string& key,
                                          const std::string& secret) {
  if (sealed.size() < kHashBytes) return std::nullopt;
  const std::string messages = sealed.substr(kHashBytes);
  if (sealed.compare(0, kHashBytes, HashOf(messages, key, secret)) != 0) return std::nullopt;
  return ResultOf(messages.data(), messages.size());
}

}  // namespace capfit::server
