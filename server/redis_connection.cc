#include "server/redis_connection.h"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/host_and_port.h"
#include "core/base/status.h"

namespace capfit::server {
namespace {

using Clock = std::chrono::steady_clock;

timeval TimeOf(std::chrono::milliseconds time) {
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {whole.count(), std::chrono::microseconds(time - whole).count()};
}

struct FreedReply {
  void operator()(redisReply* reply) const { freeReplyObject(reply); }
};

absl::StatusOr<std::string> TextOf(const redisReply& reply) {
  std::string text;
  if (reply.str != nullptr) text.assign(reply.str, reply.len);
  if (reply.type == REDIS_REPLY_ERROR) return absl::FailedPreconditionError(text);
  return text;
}

}  // namespace

absl::StatusOr<RedisPlace> RedisPlaceOf(const std::string& address) {
  RedisPlace place;
  CAPFIT_ASSIGN_OR_RETURN(const std::string whole,
                          WithPort(address, /*lowest_port=*/1, /*default_port=*/place.port));
  const std::size_t colon = whole.rfind(':');
  place.host = whole.substr(0, colon);
  place.port = std::atoi(whole.c_str() + colon + 1);
  if (place.host.front() == '[') place.host = place.host.substr(1, place.host.size() - 2);
  return place;
}

absl::StatusOr<RedisConnection> RedisConnection::Open(const RedisPlace& place) {
  RedisConnection connection(
      redisConnectWithTimeout(place.host.c_str(), place.port, TimeOf(kRedisConnectTime)),
      place.answer_time);
  if (connection.context_ == nullptr) return absl::UnavailableError("no memory for a connection");
  if (connection.context_->err != 0) return connection.Failed();
  redisSetTimeout(connection.context_.get(), TimeOf(place.answer_time));
  if (!place.password.empty()) {
    CAPFIT_RETURN_IF_ERROR(connection.Ask({"AUTH", place.password}).status());
  }
  CAPFIT_RETURN_IF_ERROR(connection.Ask({"PING"}).status());
  return connection;
}

absl::Status RedisConnection::Failed() const {
  const bool is_late = context_->err == REDIS_ERR_IO &&
                       (errno == EAGAIN || errno == EWOULDBLOCK || errno == ETIMEDOUT);
  return is_late ? absl::DeadlineExceededError("no answer in time")
                 : absl::UnavailableError(context_->errstr);
}

// Not redisCommand: that would wait anew for each piece of an answer that trickles in.
absl::StatusOr<std::string> RedisConnection::Ask(const std::vector<std::string>& words) {
  const Clock::time_point deadline = Clock::now() + answer_time_;
  std::vector<const char*> texts;
  std::vector<std::size_t> lengths;
  for (const std::string& word : words) {
    texts.push_back(word.data());
    lengths.push_back(word.size());
  }
  redisContext* const context = context_.get();
  if (redisAppendCommandArgv(context, static_cast<int>(words.size()), texts.data(),
                             lengths.data()) != REDIS_OK) {
    return Failed();
  }
  void* answer = nullptr;
  for (int all_sent = 0; answer == nullptr;) {
    const int done =
        all_sent == 0 ? redisBufferWrite(context, &all_sent) : redisBufferRead(context);
    if (done != REDIS_OK) return Failed();
    if (redisGetReplyFromReader(context, &answer) != REDIS_OK) return Failed();
    if (answer == nullptr && Clock::now() >= deadline) {
      return absl::DeadlineExceededError("no whole answer in time");
    }
  }
  const std::unique_ptr<redisReply, FreedReply> reply(static_cast<redisReply*>(answer));
  return TextOf(*reply);
}

}  // namespace capfit::server
