// One connection to a Redis server, on which nothing takes longer than it may.
#ifndef CAPFIT_SERVER_REDIS_CONNECTION_H_
#define CAPFIT_SERVER_REDIS_CONNECTION_H_

#include <hiredis/hiredis.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::server {

// How long a question may wait for its whole answer, unless the place says otherwise.
inline constexpr std::chrono::milliseconds kRedisAnswerTime{100};

// Where a Redis server is, and how long it is waited for.
struct RedisPlace {
  std::string host;
  int port = 6379;
  std::string password;  // "": none is sent
  // A read that is under way by then may take as long again.
  std::chrono::milliseconds answer_time = kRedisAnswerTime;
};

// "HOST[:PORT]" as its two parts, without a port 6379. INVALID_ARGUMENT for what is no address.
[[nodiscard]] absl::StatusOr<RedisPlace> RedisPlaceOf(const std::string& address);

// How long a connection may take to be made, once the host's name is known.
inline constexpr std::chrono::milliseconds kRedisConnectTime{50};

// For one thread at a time. Writes to sockets that may be closed: SIGPIPE must be ignored.
class RedisConnection {
 public:
  // Looks up the host, which may take as long as the system's resolver takes; connects, sends the
  // password, and waits for an answer. UNAVAILABLE where nobody listens, DEADLINE_EXCEEDED where
  // nobody answers, FAILED_PRECONDITION where the server will not talk (password, still loading).
  static absl::StatusOr<RedisConnection> Open(const RedisPlace& place);

  // The text of the answer to a command, "" where there is none. DEADLINE_EXCEEDED when it does not
  // come in time and UNAVAILABLE when the connection breaks: it is of no use then. For
  // FAILED_PRECONDITION, an error of the server's (OOM, WRONGTYPE), it may be used again.
  [[nodiscard]] absl::StatusOr<std::string> Ask(const std::vector<std::string>& words);

 private:
  struct Freed {
    void operator()(redisContext* context) const { redisFree(context); }
  };
  RedisConnection(redisContext* context, std::chrono::milliseconds answer_time)
      : context_(context), answer_time_(answer_time) {}
  [[nodiscard]] absl::Status Failed() const;

  std::unique_ptr<redisContext, Freed> context_;
  std::chrono::milliseconds answer_time_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_REDIS_CONNECTION_H_
