#include "core/base/large_pages.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <cstring>

#include "tests/support/sanitizers.h"

namespace capfit {
namespace {

long PagesTaken() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

// Pages that the kernel hands out while an array of 32 MB is filled and freed again.
long PagesForAnArray() {
  constexpr std::size_t kSize = std::size_t{32} << 20;
  const long before = PagesTaken();
  void* array = std::malloc(kSize);
  std::memset(array, 1, kSize);
  asm volatile("" : : "r"(array) : "memory");  // the array is really filled
  std::free(array);
  return PagesTaken() - before;
}

// 8192 small pages each time without.
TEST(LargePagesTest, WhatIsFreedIsKeptForTheNextArray) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "a sanitizer has a malloc of its own";
  UseLargePages();
  (void)PagesForAnArray();
  EXPECT_LT(PagesForAnArray(), 100);
}

TEST(LargePagesTest, TheOperatorsSettingsCountAndNothingStartsAnew) {
  ASSERT_EQ(setenv("GLIBC_TUNABLES", "", 1), 0);
  char* none[] = {nullptr};
  RestartWithLargePages(none);  // would not come back with such arguments
  EXPECT_STREQ(std::getenv("GLIBC_TUNABLES"), "");
  unsetenv("GLIBC_TUNABLES");
}

}  // namespace
}  // namespace capfit
