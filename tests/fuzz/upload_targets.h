// What the fuzzer of the upload does with one input; ordinary tests replay the corpus with it.
#ifndef CAPFIT_TESTS_FUZZ_UPLOAD_TARGETS_H_
#define CAPFIT_TESTS_FUZZ_UPLOAD_TARGETS_H_

#include <cstddef>
#include <span>
#include <string>

namespace capfit::fuzz {

// The bytes are the messages of an upload: each one byte that says what it is, its size, and its
// content, for the wire or in short. They are put together as the server does, and what comes out
// is prepared: any messages give an error or a mesh that keeps its promises. Returns the broken
// promise, empty if there is none.
[[nodiscard]] std::string TryUpload(std::span<const std::byte> bytes);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_UPLOAD_TARGETS_H_
