// What the fuzzer of the body room does with one input; ordinary tests replay the corpus with it.
#ifndef CAPFIT_TESTS_FUZZ_BODY_TARGETS_H_
#define CAPFIT_TESTS_FUZZ_BODY_TARGETS_H_

#include <cstddef>
#include <span>
#include <string>

namespace capfit::fuzz {

// The first byte chooses the start: a coarse mannequin that the other bytes dent, stretch, cut,
// turn, tear and sew up, or a soup of a few faces (see mesh_targets.h). Preparing the mesh and
// finding the body in it gives an error or what both rooms promise. Returns the broken promise,
// empty if there is none.
[[nodiscard]] std::string TryFindBody(std::span<const std::byte> bytes);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_BODY_TARGETS_H_
