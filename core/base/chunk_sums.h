// Sums over many things that come out the same for any number of threads.
#ifndef CAPFIT_CORE_BASE_CHUNK_SUMS_H_
#define CAPFIT_CORE_BASE_CHUNK_SUMS_H_

#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/thread_pool.h"

namespace capfit {

// Triangles or vertices that make a task worth its start: some ten microseconds.
inline constexpr std::size_t kMeshChunk = 4096;

// `zero` and the parts of [0, count) that part(begin, end) gives for chunks of kMeshChunk, added
// with += in index order.
template <typename Sum, typename Part>
[[nodiscard]] Sum SumOverChunks(const ThreadPool& pool, std::size_t count, Sum zero,
                                const Part& part) {
  std::vector<Sum> sums((count + kMeshChunk - 1) / kMeshChunk, zero);
  pool.ForChunks(count, kMeshChunk, [&](std::size_t begin, std::size_t end) {
    sums[begin / kMeshChunk] = part(begin, end);
  });
  for (const Sum& sum : sums) zero += sum;
  return zero;
}

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_CHUNK_SUMS_H_
