// The door to the one compute pool of the process (oneTBB: nested loops, work stealing).
#ifndef CAPFIT_CORE_BASE_THREAD_POOL_H_
#define CAPFIT_CORE_BASE_THREAD_POOL_H_

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

namespace capfit {

// A share of the process's cores. Cheap to keep, safe to use from several threads at once; loops
// may nest. Results must not depend on which thread runs what: give each index its own output and
// combine them in index order, then the number of threads never changes a bit.
class ThreadPool {
 public:
  // `threads` >= 1 take part, the calling thread included; 0: one per core
  // that the process may keep busy (AvailableCores). The others start at once, beside what the
  // caller does next: make the pool before reading what it will work on.
  explicit ThreadPool(int threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int threads() const { return threads_; }

  // Calls body(i) once for each i in [0, count) and waits for all. They begin in order: where some
  // take longer, put them first.
  void ForEach(std::size_t count, const std::function<void(std::size_t)>& body) const;

  // Calls body(begin, end) over fixed chunks of `chunk` indices that cover [0, count): the chunks
  // are the same for any number of threads. For loops whose single step is too small to be a task.
  // Each thread begins with a part of its own, the same for equal counts and chunks.
  void ForChunks(std::size_t count, std::size_t chunk,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) const;

  // While it lives, its thread computes one of several jobs that share the pool, such as one fit of
  // a server's. Where there are as many jobs as threads, loops stay on the threads that call them:
  // no core waits for another, and all jobs together are done sooner.
  class Job {
   public:
    explicit Job(const ThreadPool& pool) : jobs_(pool.jobs_) { ++jobs_; }
    ~Job() { --jobs_; }
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

   private:
    std::atomic<int>& jobs_;
  };

 private:
  struct Arena;

  // Whether a loop over so many gains from other threads now.
  [[nodiscard]] bool Helps(std::size_t count) const;

  // Calls run(number of the thread, from 0) `count` times.
  template <typename Run>
  void RunSideBySide(std::size_t count, const Run& run) const;

  std::unique_ptr<Arena> arena_;
  int threads_;
  mutable std::atomic<int> jobs_ = 0;
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_THREAD_POOL_H_
