// How wide a text stands on a terminal.
#ifndef CAPFIT_CLIENT_TEXT_WIDTH_H_
#define CAPFIT_CLIENT_TEXT_WIDTH_H_

#include <cstddef>
#include <string>

namespace capfit::client {

// In columns: letters of several bytes take one or, as Chinese and Japanese ones, two; marks that
// are set on the letter before take none. What is no UTF-8 counts a column for each byte.
[[nodiscard]] std::size_t TextWidth(const std::string& text);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_TEXT_WIDTH_H_
