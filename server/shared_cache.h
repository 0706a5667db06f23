// Results that several servers share, in Redis.
#ifndef CAPFIT_SERVER_SHARED_CACHE_H_
#define CAPFIT_SERVER_SHARED_CACHE_H_

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "core/pipeline/fit.h"
#include "server/metrics.h"
#include "server/redis_store.h"
#include "server/server_config.h"

namespace capfit::server {

// A result that takes more bytes than this is not shared: in kRedisAnswerTime a line of a gigabit a
// second carries about 12 MiB.
inline constexpr std::size_t kMostSharedBytes = 8 * 1024 * 1024;

// Behind ResultCache, for what another replica has fitted. Nothing that is wrong with Redis fails a
// call or changes a result: what it gives is taken only with the right hash (sealed_result.h), and
// one that fails is not asked (redis_store.h). Both are counted. Safe from any thread but gRPC's:
// asking may take config.cache_redis_seconds.
class SharedCache {
 public:
  // Off where the config names no Redis. INVALID_ARGUMENT for what is no address, and for a
  // password's file that cannot be read. `metrics` must outlive it.
  static absl::StatusOr<std::unique_ptr<SharedCache>> Create(const ServerConfig& config,
                                                             Metrics& metrics);

  [[nodiscard]] bool is_on() const { return store_ != nullptr; }
  // Whether Redis answers.
  [[nodiscard]] bool is_up() const { return is_on() && store_->is_up(); }
  // `key`: as ResultCache.
  [[nodiscard]] std::optional<pipeline::FitResult> Find(const std::string& key);
  void Keep(const std::string& key, const pipeline::FitResult& result);

 private:
  explicit SharedCache(Metrics& metrics) : metrics_(metrics) {}

  Metrics& metrics_;
  std::string secret_;
  std::unique_ptr<RedisStore> store_;
};

// The Redis that the config names, with its password and the time to wait for it. Errors as Create.
[[nodiscard]] absl::StatusOr<RedisPlace> RedisOf(const ServerConfig& config);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SHARED_CACHE_H_
