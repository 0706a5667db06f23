// Pictures as pixels, to be looked at by tests.
#ifndef CAPFIT_TESTS_CLIENT_PICTURE_READ_PNG_H_
#define CAPFIT_TESTS_CLIENT_PICTURE_READ_PNG_H_

#include <string>

#include "client/picture/panel.h"

namespace capfit::client {

// The colours of a PNG; none of what is no PNG.
[[nodiscard]] Pixels ReadPng(const std::string& bytes);

// The largest difference of any channel of any pixel, of 255; 255 where the sizes differ.
[[nodiscard]] int LargestDifference(const Pixels& a, const Pixels& b);

}  // namespace capfit::client

#endif  // CAPFIT_TESTS_CLIENT_PICTURE_READ_PNG_H_
