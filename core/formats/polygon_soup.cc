#include "core/formats/polygon_soup.h"

namespace capfit::formats {

bool PolygonSoup::HasTrianglesOnly() const {
  bool all_are = true;  // a loop without an exit, which vectorises
  for (const std::uint32_t size : face_sizes) all_are &= size == 3;
  return all_are;
}

PolygonSoup WithFaces(const PolygonSoup& soup, std::span<const char> mark, char value) {
  PolygonSoup some;
  some.is_from_file = soup.is_from_file;
  std::size_t at = 0;
  for (std::size_t face = 0; face < soup.face_count(); ++face) {
    const std::size_t size = soup.face_sizes.empty() ? 3 : soup.face_sizes[face];
    if (mark[face] == value) {
      const auto corner = soup.face_vertices.begin() + static_cast<std::ptrdiff_t>(at);
      some.face_vertices.insert(some.face_vertices.end(), corner,
                                corner + static_cast<std::ptrdiff_t>(size));
      if (!soup.face_sizes.empty()) some.face_sizes.push_back(soup.face_sizes[face]);
    }
    at += size;
  }
  return some;
}

}  // namespace capfit::formats
