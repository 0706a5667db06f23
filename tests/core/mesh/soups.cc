#include "tests/core/mesh/soups.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/base/random.h"
#include "core/mesh/triangulate_faces.h"

namespace capfit::mesh {
namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

Faces FacesOf(const formats::PolygonSoup& soup) {
  Faces faces;
  std::size_t first = 0;
  const std::size_t count =
      soup.face_sizes.empty() ? soup.face_vertices.size() / 3 : soup.face_sizes.size();
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t size = soup.face_sizes.empty() ? 3 : soup.face_sizes[f];
    faces.emplace_back(soup.face_vertices.begin() + static_cast<std::ptrdiff_t>(first),
                       soup.face_vertices.begin() + static_cast<std::ptrdiff_t>(first + size));
    first += size;
  }
  return faces;
}

formats::PolygonSoup With(std::vector<Eigen::Vector3d> positions, const Faces& faces) {
  formats::PolygonSoup soup;
  soup.positions = std::move(positions);
  for (const auto& face : faces) {
    soup.face_sizes.push_back(static_cast<std::uint32_t>(face.size()));
    soup.face_vertices.insert(soup.face_vertices.end(), face.begin(), face.end());
  }
  return soup;
}

}  // namespace

formats::PolygonSoup Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 4) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                         (i & 1) != 0 ? high.z() : low.z());
  }
  return With(std::move(corners),
              {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}});
}

formats::PolygonSoup Cube() { return Box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()); }

formats::PolygonSoup Ball(int meridians, int parallels, double radius) {
  formats::PolygonSoup ball;
  for (int p = 1; p <= parallels; ++p) {
    const double polar = std::numbers::pi * p / (parallels + 1);
    for (int m = 0; m < meridians; ++m) {
      const double angle = 2.0 * std::numbers::pi * m / meridians;
      ball.positions.emplace_back(radius * std::sin(polar) * std::cos(angle),
                                  radius * std::sin(polar) * std::sin(angle),
                                  radius * std::cos(polar));
    }
  }
  const auto north = static_cast<std::uint32_t>(ball.positions.size());
  ball.positions.emplace_back(0.0, 0.0, radius);
  ball.positions.emplace_back(0.0, 0.0, -radius);
  const auto at = [&](int p, int m) {
    return static_cast<std::uint32_t>(p * meridians + m % meridians);
  };
  for (int m = 0; m < meridians; ++m) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      ball.face_vertices.insert(ball.face_vertices.end(), {a, b, c});
    };
    add(north, at(0, m), at(0, m + 1));
    add(north + 1, at(parallels - 1, m + 1), at(parallels - 1, m));
    for (int p = 0; p + 1 < parallels; ++p) {
      add(at(p, m), at(p + 1, m), at(p + 1, m + 1));
      add(at(p, m), at(p + 1, m + 1), at(p, m + 1));
    }
  }
  return ball;
}

std::vector<Triangle> TrianglesOf(const formats::PolygonSoup& soup) {
  const std::span<const Triangle> faces = FacesAsTriangles(soup);
  return {faces.begin(), faces.end()};
}

formats::PolygonSoup Together(const formats::PolygonSoup& a, const formats::PolygonSoup& b) {
  std::vector<Eigen::Vector3d> positions = a.positions;
  positions.insert(positions.end(), b.positions.begin(), b.positions.end());
  Faces faces = FacesOf(a);
  for (std::vector<std::uint32_t>& face : FacesOf(b)) {
    for (std::uint32_t& v : face) v += static_cast<std::uint32_t>(a.positions.size());
    faces.push_back(std::move(face));
  }
  return With(std::move(positions), faces);
}

formats::PolygonSoup Moved(formats::PolygonSoup soup, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& position : soup.positions) position += by;
  return soup;
}

formats::PolygonSoup WithoutFaces(const formats::PolygonSoup& soup, std::size_t first,
                                  std::size_t count) {
  Faces faces = FacesOf(soup);
  faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(first),
              faces.begin() + static_cast<std::ptrdiff_t>(first + count));
  return With(soup.positions, faces);
}

formats::PolygonSoup WithFace(formats::PolygonSoup soup, std::vector<std::uint32_t> corners) {
  Faces faces = FacesOf(soup);
  faces.push_back(std::move(corners));
  return With(std::move(soup.positions), faces);
}

formats::PolygonSoup SplitApart(const formats::PolygonSoup& soup) {
  formats::PolygonSoup split;
  split.face_sizes = soup.face_sizes;
  for (const std::uint32_t v : soup.face_vertices) {
    split.face_vertices.push_back(static_cast<std::uint32_t>(split.positions.size()));
    split.positions.push_back(soup.positions[v]);
  }
  return split;
}

formats::PolygonSoup RandomlyTurned(const formats::PolygonSoup& soup, double chance,
                                    std::uint64_t seed) {
  Random random(seed);
  Faces faces = FacesOf(soup);
  for (std::vector<std::uint32_t>& face : faces) {
    if (random.NextUnit() < chance) std::reverse(face.begin() + 1, face.end());
  }
  return With(soup.positions, faces);
}

formats::PolygonSoup Shuffled(const formats::PolygonSoup& soup, std::uint64_t seed) {
  Random random(seed);
  Faces faces = FacesOf(soup);
  for (std::size_t i = faces.size(); i > 1; --i) {
    std::swap(faces[i - 1], faces[random.NextBelow(i)]);
  }
  return With(soup.positions, faces);
}

Surface SurfaceOf(std::vector<Triangle> triangles, std::size_t vertices) {
  EdgeMates mates = FindEdgeMates(triangles, vertices);
  return {std::move(triangles), std::move(mates.mate)};
}

Surface WithHoles(const formats::PolygonSoup& soup, double chance, std::uint64_t seed) {
  std::vector<Triangle> triangles;
  Random random(seed);
  const std::vector<std::uint32_t>& v = soup.face_vertices;
  for (std::size_t i = 0; i < v.size(); i += 3) {
    if (random.NextUnit() >= chance) triangles.push_back({v[i], v[i + 1], v[i + 2]});
  }
  return SurfaceOf(std::move(triangles), soup.positions.size());
}

SurfaceKey KeyOf(const BodyMesh& mesh, double grid) {
  SurfaceKey key;
  for (const Triangle& t : mesh.triangles()) {
    auto& corners = key.emplace_back();
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        corners[k][axis] = std::llround(mesh.vertices()[t[k]][axis] / grid);
      }
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
  std::sort(key.begin(), key.end());
  return key;
}

std::int64_t CountOf(const PreparedMesh& prepared, const std::string& code) {
  for (const Warning& warning : prepared.warnings) {
    if (warning.code == code) return warning.count;
  }
  return 0;
}

std::string CodesOf(const PreparedMesh& prepared) {
  std::string codes;
  for (const Warning& warning : prepared.warnings) {
    codes += (codes.empty() ? "" : " ") + warning.code;
  }
  return codes;
}

}  // namespace capfit::mesh
