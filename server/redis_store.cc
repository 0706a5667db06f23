#include "server/redis_store.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace capfit::server {
namespace {

using Clock = std::chrono::steady_clock;

// Results of versions that nobody runs any more go by themselves.
constexpr char kWeekInSeconds[] = "604800";

RedisFailure KindOf(const absl::Status& status) {
  if (absl::IsDeadlineExceeded(status)) return RedisFailure::kLate;
  return absl::IsFailedPrecondition(status) ? RedisFailure::kRefused : RedisFailure::kLost;
}

}  // namespace

RedisStore::RedisStore(RedisPlace place, std::size_t most_idle,
                       std::function<void(RedisFailure)> on_failure)
    : place_(std::move(place)),
      most_idle_(most_idle),
      on_failure_(std::move(on_failure)),
      connector_([this] { KeepConnected(); }) {}

RedisStore::~RedisStore() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  connector_.join();
}

bool RedisStore::is_up() const {
  const std::lock_guard lock(mutex_);
  return is_up_.value_or(false);
}

std::optional<std::string> RedisStore::Get(const std::string& key, std::size_t most_bytes) {
  // A piece: what somebody else keeps under our key must not fill the memory.
  absl::StatusOr<std::string> value = Ask({"GETRANGE", key, "0", std::to_string(most_bytes - 1)});
  if (!value.ok() || value->empty()) return std::nullopt;
  return *std::move(value);
}

void RedisStore::Set(const std::string& key, const std::string& value) {
  {
    const std::lock_guard lock(mutex_);
    if (Clock::now() < next_write_) return;
  }
  if (!absl::IsFailedPrecondition(Ask({"SET", key, value, "EX", kWeekInSeconds}).status())) return;
  // Full, or a replica that only reads: large values need not be sent to it again and again.
  const std::lock_guard lock(mutex_);
  next_write_ = Clock::now() + kRedisPause;
}

absl::StatusOr<std::string> RedisStore::Ask(const std::vector<std::string>& words) {
  std::optional<RedisConnection> connection = Take();
  if (!connection) return absl::UnavailableError("not connected");
  absl::StatusOr<std::string> answer = connection->Ask(words);
  if (answer.ok() || absl::IsFailedPrecondition(answer.status())) {
    GiveBack(*std::move(connection));
  } else {
    const std::lock_guard lock(mutex_);
    GiveUp(answer.status());
  }
  if (!answer.ok()) on_failure_(KindOf(answer.status()));
  return answer;
}

std::optional<RedisConnection> RedisStore::Take() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) {
    is_wanted_ = true;
    wake_.notify_one();
    return std::nullopt;
  }
  std::optional<RedisConnection> connection(std::move(idle_.back()));
  idle_.pop_back();
  return connection;
}

void RedisStore::GiveBack(RedisConnection connection) {
  const std::lock_guard lock(mutex_);
  if (idle_.size() < most_idle_) idle_.push_back(std::move(connection));
}

void RedisStore::GiveUp(const absl::Status& status) {
  idle_.clear();
  is_wanted_ = true;
  next_attempt_ = Clock::now() + kRedisPause;
  wake_.notify_one();
  if (is_up_.value_or(true)) {
    spdlog::warn("Redis at {}:{} fails ({}); going on without it, asked again every {} s",
                 place_.host, place_.port, std::string(status.message()), kRedisPause.count());
  }
  is_up_ = false;
}

void RedisStore::KeepConnected() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (!is_wanted_) {
      wake_.wait(lock);
      continue;
    }
    if (Clock::now() < next_attempt_) {
      wake_.wait_until(lock, next_attempt_);
      continue;
    }
    lock.unlock();
    absl::StatusOr<RedisConnection> connection = RedisConnection::Open(place_);
    if (!connection.ok()) on_failure_(RedisFailure::kConnect);
    lock.lock();
    if (!connection.ok()) {
      GiveUp(connection.status());
      continue;
    }
    idle_.push_back(*std::move(connection));
    is_wanted_ = false;
    if (!is_up_.value_or(false)) spdlog::info("Redis at {}:{} answers", place_.host, place_.port);
    is_up_ = true;
  }
}

}  // namespace capfit::server
