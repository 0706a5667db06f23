// A coarse mannequin that fuzz bytes change.
#ifndef CAPFIT_TESTS_FUZZ_DENTED_BODY_H_
#define CAPFIT_TESTS_FUZZ_DENTED_BODY_H_

#include "core/formats/polygon_soup.h"
#include "tests/fuzz/byte_source.h"

namespace capfit::fuzz {

// First byte: which mannequin. Then operations of one byte and its arguments until the bytes are
// used up: a few bytes give a body that was turned, cut, dented, torn or sewn to itself.
[[nodiscard]] formats::PolygonSoup DentedBody(ByteSource source);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_DENTED_BODY_H_
