#include "server/watchdog.h"

namespace capfit::server {

Watchdog::Watchdog() : thread_([this] { Run(); }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

Watchdog::Alarm Watchdog::Set(Clock::time_point when, std::function<void()> ring) {
  const std::lock_guard lock(mutex_);
  const Alarm alarm{when, ++last_};
  alarms_.emplace(alarm, std::move(ring));
  if (alarms_.begin()->first == alarm) wake_.notify_one();
  return alarm;
}

void Watchdog::Drop(const Alarm& alarm) {
  std::function<void()> dropped;
  const std::lock_guard lock(mutex_);
  const auto found = alarms_.find(alarm);
  if (found == alarms_.end()) return;
  dropped = std::move(found->second);
  alarms_.erase(found);
}

void Watchdog::Run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (alarms_.empty()) {
      wake_.wait(lock);
      continue;
    }
    const Clock::time_point when = alarms_.begin()->first.first;
    if (Clock::now() < when) {
      wake_.wait_until(lock, when);
      continue;
    }
    {
      const std::function<void()> ring = std::move(alarms_.extract(alarms_.begin()).mapped());
      lock.unlock();
      ring();
    }  // what it held on to goes without the lock, as in Drop
    lock.lock();
  }
}

}  // namespace capfit::server
