// A result as bytes that another server may keep, and that prove what they are the result of.
#ifndef CAPFIT_SERVER_SEALED_RESULT_H_
#define CAPFIT_SERVER_SEALED_RESULT_H_

#include <optional>
#include <string>

#include "core/pipeline/fit.h"

namespace capfit::server {

// The messages of the answer, behind the SHA-256 of `secret`, `key` and these messages. Nothing
// where they would not give the same result back, bit for bit. About 10 ms for 8 MiB.
//
// `key`: of ResultCache. `secret`: what only those know who may write; "" where anyone may.
[[nodiscard]] std::optional<std::string> Seal(const pipeline::FitResult& result,
                                              const std::string& key, const std::string& secret);

// The result, where `sealed` is what Seal gave for this key and this secret; nothing for anything
// else: another body's or another version's result, cut, changed or foreign bytes.
[[nodiscard]] std::optional<pipeline::FitResult> Unseal(const std::string& sealed,
                                                        const std::string& key,
                                                        const std::string& secret);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SEALED_RESULT_H_
