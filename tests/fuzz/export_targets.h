// What the fuzzer of the exports does with one input; ordinary tests replay the corpus with it.
#ifndef CAPFIT_TESTS_FUZZ_EXPORT_TARGETS_H_
#define CAPFIT_TESTS_FUZZ_EXPORT_TARGETS_H_

#include <cstddef>
#include <span>
#include <string>

namespace capfit::fuzz {

// The first byte is left out (it names a format in the corpus of read_mesh), the rest is a glTF
// file. Written back with colliders on its joints it gives an error or a file that reads as the
// same mesh. Returns the broken promise, empty if there is none.
[[nodiscard]] std::string TryWriteBack(std::span<const std::byte> bytes);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_EXPORT_TARGETS_H_
