#include "server/result_cache.h"

#include "server/result_bytes.h"

namespace capfit::server {

ResultCache::Result ResultCache::Find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = by_key_.find(key);
  if (found == by_key_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->result;
}

void ResultCache::Keep(const std::string& key, const pipeline::FitResult& result) {
  const std::int64_t bytes = ResultBytes(result);
  if (bytes > max_bytes_ / 4) return;
  auto kept = std::make_shared<const pipeline::FitResult>(result);
  const std::lock_guard lock(mutex_);
  if (by_key_.contains(key)) return;  // two of the same ran side by side
  entries_.push_front({key, std::move(kept), bytes});
  by_key_[key] = entries_.begin();
  bytes_ += bytes;
  while (bytes_ > max_bytes_) DropOldest();
}

void ResultCache::DropOldest() {
  bytes_ -= entries_.back().bytes;
  by_key_.erase(entries_.back().key);
  entries_.pop_back();
}

std::int64_t ResultCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace capfit::server
