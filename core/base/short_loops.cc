#include "core/base/short_loops.h"

#include <algorithm>
#include <thread>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace capfit {
namespace {

// So often a thread looks before it does: some hundred microseconds.
constexpr int kLooks = 4000;

// Waits for a moment; once it has waited long, it lets others have the core.
class Patience {
 public:
  void Wait() {
    if (++looks_ > kLooks) return std::this_thread::yield();
#if defined(__x86_64__)
    _mm_pause();
#elif defined(__aarch64__)
    asm volatile("isb");
#endif
  }
  void Renew() { looks_ = 0; }

 private:
  int looks_ = 0;
};

// Loop, first and end of the steps that are left, in one number.
std::uint64_t Left(std::uint64_t loop, std::uint64_t first, std::uint64_t end) {
  return loop << 32 | first << 16 | end;
}
std::uint64_t FirstOf(std::uint64_t left) { return left >> 16 & 0xFFFFu; }
std::uint64_t EndOf(std::uint64_t left) { return left & 0xFFFFu; }

constexpr std::uint64_t kOneFirst = 1u << 16;
constexpr std::uint64_t kOneEnd = 1;

}  // namespace

void ShortLoops::Run(const ThreadPool& pool, int most_threads,
                     const std::function<void(ShortLoops&)>& work) {
  const auto threads = static_cast<std::size_t>(std::clamp(pool.threads(), 1, most_threads));
  ShortLoops loops;
  pool.ForEach(threads, [&](std::size_t i) {
    if (i > 0) return loops.Help();
    work(loops);
    loops.is_over_.store(true, std::memory_order_release);
  });
}

void ShortLoops::ForEach(std::size_t count, Body body) {
  if (count < 2 || helpers_.load(std::memory_order_relaxed) == 0) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  body_ = &body;
  helped_.store(0, std::memory_order_relaxed);
  left_.store(Left(++loop_, 0, count), std::memory_order_release);
  std::size_t done = 0;
  for (std::size_t step = 0; TakeFirst(step); ++done) body(step);
  for (Patience patience; done + helped_.load(std::memory_order_acquire) < count;) patience.Wait();
}

void ShortLoops::Help() {
  helpers_.fetch_add(1, std::memory_order_relaxed);
  Patience patience;
  while (!is_over_.load(std::memory_order_acquire)) {
    std::size_t step = 0;
    if (!TakeLast(step)) {
      patience.Wait();
      continue;
    }
    (*body_)(step);
    helped_.fetch_add(1, std::memory_order_release);
    patience.Renew();
  }
}

bool ShortLoops::TakeFirst(std::size_t& step) {
  std::uint64_t left = left_.load(std::memory_order_relaxed);
  while (FirstOf(left) < EndOf(left)) {
    step = FirstOf(left);
    if (left_.compare_exchange_weak(left, left + kOneFirst, std::memory_order_relaxed)) return true;
  }
  return false;
}

bool ShortLoops::TakeLast(std::size_t& step) {
  std::uint64_t left = left_.load(std::memory_order_acquire);
  while (FirstOf(left) < EndOf(left)) {
    step = EndOf(left) - 1;
    if (left_.compare_exchange_weak(left, left - kOneEnd, std::memory_order_acquire)) return true;
  }
  return false;
}

}  // namespace capfit
