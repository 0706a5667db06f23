#include "client/picture/write_mesh.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <span>

#include "absl/strings/str_cat.h"

namespace capfit::client {
namespace {

static_assert(std::endian::native == std::endian::little, "PlyBytes copies numbers as they are");

void AppendNumber(double value, std::string& text) {
  std::array<char, 64> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::fixed, 7);
  text.append(digits.data(), end.ptr);
}

template <typename Value>
void AppendRaw(const Value& value, std::string& bytes) {
  std::array<char, sizeof(Value)> raw;
  std::memcpy(raw.data(), &value, sizeof(Value));
  bytes.append(raw.data(), raw.size());
}

// Calls visit(corners) for each face.
template <typename Visit>
void ForEachFace(const formats::PolygonSoup& soup, const Visit& visit) {
  const std::size_t faces =
      soup.face_sizes.empty() ? soup.face_vertices.size() / 3 : soup.face_sizes.size();
  std::span<const std::uint32_t> rest = soup.face_vertices;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t size = soup.face_sizes.empty() ? 3 : soup.face_sizes[f];
    visit(rest.first(size));
    rest = rest.subspan(size);
  }
}

}  // namespace

std::string ObjText(const formats::PolygonSoup& soup) {
  std::string text;
  text.reserve(40 * soup.positions.size() + 8 * soup.face_vertices.size());
  for (const Eigen::Vector3d& p : soup.positions) {
    text += 'v';
    for (int k = 0; k < 3; ++k) {
      text += ' ';
      AppendNumber(p[k], text);
    }
    text += '\n';
  }
  ForEachFace(soup, [&](std::span<const std::uint32_t> corners) {
    text += 'f';
    for (const std::uint32_t v : corners) absl::StrAppend(&text, " ", v + 1);
    text += '\n';
  });
  return text;
}

std::string PlyBytes(const formats::PolygonSoup& soup) {
  std::size_t faces = 0;
  ForEachFace(soup, [&](std::span<const std::uint32_t>) { ++faces; });
  std::string bytes =
      absl::StrCat("ply\nformat binary_little_endian 1.0\nelement vertex ", soup.positions.size(),
                   "\nproperty double x\nproperty double y\nproperty double z\nelement face ",
                   faces, "\nproperty list uchar uint vertex_indices\nend_header\n");
  for (const Eigen::Vector3d& p : soup.positions) {
    for (int k = 0; k < 3; ++k) AppendRaw(p[k], bytes);
  }
  ForEachFace(soup, [&](std::span<const std::uint32_t> corners) {
    AppendRaw(static_cast<unsigned char>(corners.size()), bytes);
    for (const std::uint32_t v : corners) AppendRaw(v, bytes);
  });
  return bytes;
}

}  // namespace capfit::client
