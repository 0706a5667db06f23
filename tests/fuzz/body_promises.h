// What FindBody promises, checked the slow way: for tests and fuzzers.
#ifndef CAPFIT_TESTS_FUZZ_BODY_PROMISES_H_
#define CAPFIT_TESTS_FUZZ_BODY_PROMISES_H_

#include <string>

#include "absl/status/statusor.h"
#include "core/body/body.h"

namespace capfit::fuzz {

// The first promise that the outcome breaks: sizes, finite numbers, ranges, medial curves that go
// on, warnings and refusals with a code and a reason. Empty if it keeps all.
[[nodiscard]] std::string BrokenPromiseOfBody(const absl::StatusOr<body::Body>& found);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_BODY_PROMISES_H_
