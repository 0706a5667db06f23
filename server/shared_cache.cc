#include "server/shared_cache.h"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "server/result_bytes.h"
#include "server/sealed_result.h"

namespace capfit::server {
namespace {

// Larger ones need not be put into messages to see that they are too large.
constexpr std::int64_t kMostBytesInMemory = 2 * std::int64_t{kMostSharedBytes};

const char* NameOf(RedisFailure failure) {
  switch (failure) {
    case RedisFailure::kConnect:
      return "connect";
    case RedisFailure::kLate:
      return "late";
    case RedisFailure::kLost:
      return "lost";
    case RedisFailure::kRefused:
      break;
  }
  return "refused";
}

std::string NameInRedis(const std::string& key) {
  return absl::StrCat("capfit:result:", absl::BytesToHexString(key));
}

}  // namespace

absl::StatusOr<RedisPlace> RedisOf(const ServerConfig& config) {
  absl::StatusOr<RedisPlace> place = RedisPlaceOf(config.cache_redis);
  if (!place.ok()) {
    return InvalidField(ErrorReason::kOutOfRange, "--cache-redis",
                        std::string(place.status().message()));
  }
  place->answer_time = std::chrono::ceil<std::chrono::milliseconds>(
      std::chrono::duration<double>(config.cache_redis_seconds));
  if (config.cache_redis_password_file.empty()) return place;
  std::ifstream in(config.cache_redis_password_file);
  if (!std::getline(in, place->password) || place->password.empty()) {
    return InvalidField(ErrorReason::kMissing, config.cache_redis_password_file,
                        "cannot be read or is empty, must hold the password of Redis in its "
                        "first line");
  }
  return place;
}

absl::StatusOr<std::unique_ptr<SharedCache>> SharedCache::Create(const ServerConfig& config,
                                                                 Metrics& metrics) {
  std::unique_ptr<SharedCache> cache(new SharedCache(metrics));
  if (config.cache_redis.empty()) return cache;
  CAPFIT_ASSIGN_OR_RETURN(RedisPlace place, RedisOf(config));
  cache->secret_ = place.password;
  cache->store_ = std::make_unique<RedisStore>(
      std::move(place), static_cast<std::size_t>(config.max_concurrent_fits),
      [&metrics](RedisFailure failure) { metrics.CountCacheError(NameOf(failure)); });
  return cache;
}

std::optional<pipeline::FitResult> SharedCache::Find(const std::string& key) {
  if (!is_on()) return std::nullopt;
  const std::optional<std::string> sealed = store_->Get(NameInRedis(key), kMostSharedBytes + 1);
  if (!sealed) return std::nullopt;
  std::optional<pipeline::FitResult> result = Unseal(*sealed, key, secret_);
  if (!result) metrics_.CountCacheError("wrong");
  return result;
}

void SharedCache::Keep(const std::string& key, const pipeline::FitResult& result) {
  if (!is_up() || ResultBytes(result) > kMostBytesInMemory) return;
  const std::optional<std::string> sealed = Seal(result, key, secret_);
  if (!sealed || sealed->size() > kMostSharedBytes) return;
  store_->Set(NameInRedis(key), *sealed);
}

}  // namespace capfit::server
