// Bytes by key in a Redis server that may be slow, full or gone.
#ifndef CAPFIT_SERVER_REDIS_STORE_H_
#define CAPFIT_SERVER_REDIS_STORE_H_

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/redis_connection.h"

namespace capfit::server {

// What went wrong: in the metrics as the label `kind`.
enum class RedisFailure {
  kConnect,  // there is no connection to be had
  kLate,     // no answer within the answer time of its place
  kLost,     // the connection broke
  kRefused,  // the server answered with an error: no memory, no password, ...
};

// A thread of its own makes the connections, so that whoever asks never waits for a host's name or
// for one that is not there: without a connection there is simply nothing to be found. After a
// failure all connections are given up, and the server is left alone for kRedisPause. So a server
// that stops answering costs each caller one answer time, once.
//
// Safe from any thread.
class RedisStore {
 public:
  // At most `most_idle` connections are kept: as many as ask at the same time. `on_failure` is
  // called from any thread.
  RedisStore(RedisPlace place, std::size_t most_idle, std::function<void(RedisFailure)> on_failure);
  ~RedisStore();
  RedisStore(const RedisStore&) = delete;
  RedisStore& operator=(const RedisStore&) = delete;

  // At most `most_bytes` of the value; nothing where there is none, or no server.
  [[nodiscard]] std::optional<std::string> Get(const std::string& key, std::size_t most_bytes);
  // Kept for a week at most, less where the server makes room. Does nothing without a server.
  void Set(const std::string& key, const std::string& value);
  // Whether the last that was heard of the server was an answer.
  [[nodiscard]] bool is_up() const;

 private:
  using Time = std::chrono::steady_clock::time_point;

  [[nodiscard]] absl::StatusOr<std::string> Ask(const std::vector<std::string>& words);
  [[nodiscard]] std::optional<RedisConnection> Take();
  void GiveBack(RedisConnection connection);
  // With mutex_ held: nobody asks until a connection has been made anew.
  void GiveUp(const absl::Status& status);
  void KeepConnected();

  const RedisPlace place_;
  const std::size_t most_idle_;
  const std::function<void(RedisFailure)> on_failure_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<RedisConnection> idle_;
  bool is_wanted_ = true;      // one more connection
  std::optional<bool> is_up_;  // not known at first
  bool stopping_ = false;
  Time next_attempt_;
  Time next_write_;
  std::thread connector_;
};

// How long a server that failed is left alone.
inline constexpr std::chrono::seconds kRedisPause{5};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_REDIS_STORE_H_
