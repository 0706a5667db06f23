// How programs that fit bodies get their memory from the system.
//
// A fit fills fresh arrays of some megabytes again and again. Page by page the kernel takes a third
// of the time of a first fit of 64,000 triangles that way, and more on virtual machines. Large
// pages (2 MB, where the kernel has transparent ones for those who ask) and freed memory that is
// kept for the next array spare most of it.
#ifndef CAPFIT_CORE_BASE_LARGE_PAGES_H_
#define CAPFIT_CORE_BASE_LARGE_PAGES_H_

namespace capfit {

// For programs that fit on their main thread: sets up glibc's heap of that thread. It may grow by
// 256 MB in large pages, of which only those that are used take memory, and keeps what is freed.
// Once, before there are other threads.
void UseLargePages();

// For programs that fit on other threads, whose heaps only GLIBC_TUNABLES in the environment
// reaches, and that only when a program starts: starts this one anew, the same process with the
// same arguments, for some tens of milliseconds. The first thing in main. Does nothing where
// GLIBC_TUNABLES is set already, be it by this or by the operator, whose word counts, and returns
// where the program cannot be started anew.
void RestartWithLargePages(char* const* argv);

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_LARGE_PAGES_H_
