// Text from elsewhere, a file or a caller, made fit to be shown.
#ifndef CAPFIT_CORE_BASE_PLAIN_TEXT_H_
#define CAPFIT_CORE_BASE_PLAIN_TEXT_H_

#include <cstddef>
#include <string>
#include <string_view>

namespace capfit {

// UTF-8, in which bytes of `text` that are none have become U+FFFD.
[[nodiscard]] std::string ValidUtf8(std::string_view text);

// The same as any client can read and any terminal show it: control characters, and those that turn
// the direction of writing, are '?'. Of more than `most_bytes` the letters that fit into those.
[[nodiscard]] std::string PlainText(std::string_view text, std::size_t most_bytes = 1000);

// The same of at most so many letters, and "..." where there are more.
[[nodiscard]] std::string ShortPlainText(std::string_view text, std::size_t most_letters);

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_PLAIN_TEXT_H_
