// Loops of some microseconds each, one soon after the other, as an iterative solver runs them.
#ifndef CAPFIT_CORE_BASE_SHORT_LOOPS_H_
#define CAPFIT_CORE_BASE_SHORT_LOOPS_H_

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "absl/functional/function_ref.h"
#include "core/base/thread_pool.h"

namespace capfit {

// To hand a loop over to the pool's threads takes longer than a short loop does. Here they are
// asked once, for all loops of a piece of work: those that come stay until its end, and wait for
// the next loop by watching for it. One that nobody else helps with costs as much as a plain loop.
// Nobody is waited for but for the step that it is at: whoever comes late, or is kept from running
// by other programs, holds up no more.
class ShortLoops {
 public:
  // Calls work(loops) on one thread, this or another, and lets threads of the pool that are idle
  // take part in its loops, `most_threads` all together at most.
  static void Run(const ThreadPool& pool, int most_threads,
                  const std::function<void(ShortLoops&)>& work);

  ShortLoops(const ShortLoops&) = delete;
  ShortLoops& operator=(const ShortLoops&) = delete;

  // Calls body(i) once for each i in [0, count), count < 65,536, and waits for all. By the thread
  // that does the work alone; not nested. In loop after loop it takes the first steps, and the
  // others the last, so that each finds in its cache what it left there.
  void ForEach(std::size_t count, absl::FunctionRef<void(std::size_t)> body);

 private:
  using Body = absl::FunctionRef<void(std::size_t)>;

  ShortLoops() = default;

  void Help();
  bool TakeFirst(std::size_t& step);
  bool TakeLast(std::size_t& step);

  std::atomic<int> helpers_ = 0;
  std::atomic<bool> is_over_ = false;
  const Body* body_ = nullptr;  // of the loop that is open
  std::uint64_t loop_ = 0;      // its number
  // Each on a cache line of its own. The loop's number and which of its steps nobody has taken yet:
  // who takes one changes all three at once, so that nobody takes a step of a loop that is over.
  alignas(64) std::atomic<std::uint64_t> left_ = 0;
  alignas(64) std::atomic<std::size_t> helped_ = 0;  // steps that helpers have done
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_SHORT_LOOPS_H_
