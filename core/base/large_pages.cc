#include "core/base/large_pages.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace capfit {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;
constexpr std::size_t kLargePage = 2 * kMegabyte;
constexpr std::size_t kHeap = 256 * kMegabyte;

constexpr const char* kName = "GLIBC_TUNABLES";
// Freed memory goes back to the system where more than 256 MB of it lie at the end of a heap, and
// arrays of 64 MB and more do so at once.
constexpr const char* kSettings =
    "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=67108864:"
    "glibc.malloc.trim_threshold=268435456:glibc.malloc.top_pad=16777216";

}  // namespace

void UseLargePages() {
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(2 * kHeap));  // all arrays are the heap's
  mallopt(M_TRIM_THRESHOLD, static_cast<int>(2 * kHeap));
  void* const heap = std::malloc(kHeap);
  if (heap == nullptr) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(heap);
  const std::uintptr_t first = (begin + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t last = (begin + kHeap) / kLargePage * kLargePage;
  // Where the kernel has none, small pages do.
  (void)madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
  std::free(heap);
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(64 * kMegabyte));
}

void RestartWithLargePages(char* const* argv) {
  if (std::getenv(kName) != nullptr) return;
  std::error_code error;  // by its own path, so that it keeps its name
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error || setenv(kName, kSettings, /*overwrite=*/0) != 0) return;
  execv(program.c_str(), argv);
  unsetenv(kName);
}

}  // namespace capfit
