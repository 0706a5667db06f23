#include "tests/client/picture/read_png.h"

#include <cairo.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace capfit::client {

Pixels ReadPng(const std::string& bytes) {
  struct Source {
    const std::string& bytes;
    std::size_t at = 0;
  } source{bytes};
  const auto read = [](void* closure, unsigned char* data, unsigned int length) {
    auto* const from = static_cast<Source*>(closure);
    if (from->bytes.size() - from->at < length) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(data, from->bytes.data() + from->at, length);
    from->at += length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* const surface = cairo_image_surface_create_from_png_stream(read, &source);
  Pixels pixels{
      cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < pixels.height; ++y) {
    std::vector<std::uint32_t> row(static_cast<std::size_t>(pixels.width));
    std::memcpy(row.data(), cairo_image_surface_get_data(surface) + y * stride, 4 * row.size());
    for (const std::uint32_t pixel : row) pixels.argb.push_back(pixel | 0xff000000u);
  }
  cairo_surface_destroy(surface);
  return pixels;
}

int LargestDifference(const Pixels& a, const Pixels& b) {
  if (a.width != b.width || a.height != b.height) return 255;
  int largest = 0;
  for (std::size_t i = 0; i < a.argb.size(); ++i) {
    for (const int shift : {0, 8, 16}) {
      const int one = static_cast<int>(a.argb[i] >> shift & 255u);
      const int other = static_cast<int>(b.argb[i] >> shift & 255u);
      largest = std::max(largest, std::abs(one - other));
    }
  }
  return largest;
}

}  // namespace capfit::client
