// Results of fits that were made before, by what they were made of.
#ifndef CAPFIT_SERVER_RESULT_CACHE_H_
#define CAPFIT_SERVER_RESULT_CACHE_H_

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "core/pipeline/fit.h"

namespace capfit::server {

// A fit gives the same bits for the same mesh, options and version, so a result may be given again.
// Holds at most `max_bytes` of results, those used last; one that takes more than a quarter of that
// is not kept. Safe from any thread.
class ResultCache {
 public:
  using Result = std::shared_ptr<const pipeline::FitResult>;

  // 0: keeps nothing.
  explicit ResultCache(std::int64_t max_bytes) : max_bytes_(max_bytes) {}

  [[nodiscard]] bool is_on() const { return max_bytes_ > 0; }
  // Null where there is none.
  [[nodiscard]] Result Find(const std::string& key);
  void Keep(const std::string& key, const pipeline::FitResult& result);
  [[nodiscard]] std::int64_t bytes() const;

 private:
  struct Entry {
    std::string key;
    Result result;
    std::int64_t bytes;
  };
  void DropOldest();

  const std::int64_t max_bytes_;
  mutable std::mutex mutex_;
  std::list<Entry> entries_;  // the one used last in front
  std::map<std::string, std::list<Entry>::iterator> by_key_;
  std::int64_t bytes_ = 0;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_RESULT_CACHE_H_
