#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "core/base/random.h"
#include "core/mannequin/mannequin.h"
#include "tests/bench/hostile_cases.h"

namespace capfit::bench {
namespace {

using Eigen::Vector3d;
using formats::PolygonSoup;

void AddTriangle(std::size_t a, std::size_t b, std::size_t c, PolygonSoup& soup) {
  for (const std::size_t v : {a, b, c}) soup.face_vertices.push_back(static_cast<std::uint32_t>(v));
}

Vector3d Anywhere(Random& random) {
  const double x = random.NextUnit();
  const double y = random.NextUnit();
  return {x, y, random.NextUnit()};
}

// `rows` rings of `around` vertices on a surface of revolution about y; ring 0 is the lowest. Caps
// close it: all their triangles meet in one vertex.
template <typename Profile>
PolygonSoup Turned(std::size_t around, std::size_t rows, Profile at, bool with_caps) {
  PolygonSoup soup;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t k = 0; k < around; ++k) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(around);
      const auto [radius, y] = at(static_cast<double>(r) / static_cast<double>(rows - 1), angle);
      soup.positions.emplace_back(radius * std::sin(angle), y, radius * std::cos(angle));
    }
  }
  for (std::size_t r = 0; r + 1 < rows; ++r) {
    for (std::size_t k = 0; k < around; ++k) {
      const std::size_t a = r * around + k;
      const std::size_t b = r * around + (k + 1) % around;
      AddTriangle(a, b, b + around, soup);
      AddTriangle(a, b + around, a + around, soup);
    }
  }
  if (!with_caps) return soup;
  for (const bool top : {false, true}) {
    const std::size_t first = top ? (rows - 1) * around : 0;
    const std::size_t tip = soup.positions.size();
    Vector3d middle = Vector3d::Zero();
    middle.y() = soup.positions[first].y();
    soup.positions.push_back(middle);
    for (std::size_t k = 0; k < around; ++k) {
      const std::size_t next = first + (k + 1) % around;
      if (top) {
        AddTriangle(first + k, next, tip, soup);
      } else {
        AddTriangle(next, first + k, tip, soup);
      }
    }
  }
  return soup;
}

PolygonSoup Sphere(std::size_t around, std::size_t rows, double radius = 1.0) {
  return Turned(
      around, rows,
      [&](double share, double) {
        const double angle = std::numbers::pi * (0.02 + 0.96 * share);
        return std::pair(radius * std::sin(angle), -radius * std::cos(angle));
      },
      true);
}

void Append(const PolygonSoup& part, const Vector3d& by, PolygonSoup& soup) {
  const auto first = static_cast<std::uint32_t>(soup.positions.size());
  for (const Vector3d& p : part.positions) soup.positions.push_back(p + by);
  for (const std::uint32_t v : part.face_vertices) soup.face_vertices.push_back(first + v);
}

PolygonSoup Mannequin(int faces) {
  mannequin::MannequinOptions options;
  options.faces = faces;
  options.quads = false;
  return *mannequin::MakeMannequin(options);
}

// Each triangle becomes four.
PolygonSoup Divided(const PolygonSoup& soup) {
  PolygonSoup fine;
  for (std::size_t i = 0; i < soup.face_vertices.size(); i += 3) {
    const std::size_t first = fine.positions.size();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& a = soup.positions[soup.face_vertices[i + k]];
      const Vector3d& b = soup.positions[soup.face_vertices[i + (k + 1) % 3]];
      fine.positions.push_back(a);
      fine.positions.push_back(0.5 * (a + b));
    }
    AddTriangle(first, first + 1, first + 5, fine);
    AddTriangle(first + 1, first + 2, first + 3, fine);
    AddTriangle(first + 5, first + 3, first + 4, fine);
    AddTriangle(first + 1, first + 3, first + 5, fine);
  }
  return fine;
}

HostileInput Of(PolygonSoup soup) { return {{}, formats::MeshFormat::kUnknown, std::move(soup)}; }

HostileInput RandomCorners() {
  Random random(1);
  PolygonSoup soup;
  for (int i = 0; i < 1'000'000; ++i) soup.positions.push_back(Anywhere(random));
  for (int i = 0; i < 6'000'000; ++i) {
    soup.face_vertices.push_back(static_cast<std::uint32_t>(random.NextBelow(1'000'000)));
  }
  return Of(std::move(soup));
}

HostileInput RandomFewCorners() {
  Random random(1);
  PolygonSoup soup;
  for (int i = 0; i < 2000; ++i) soup.positions.push_back(Anywhere(random));
  for (int i = 0; i < 6'000'000; ++i) {
    soup.face_vertices.push_back(static_cast<std::uint32_t>(random.NextBelow(2000)));
  }
  return Of(std::move(soup));
}

HostileInput OneVertexShared() {
  Random random(2);
  PolygonSoup soup;
  for (int i = 0; i < 1'000'000; ++i) soup.positions.push_back(Anywhere(random));
  for (int i = 0; i < 2'000'000; ++i) {
    AddTriangle(0, 1 + random.NextBelow(999'999), 1 + random.NextBelow(999'999), soup);
  }
  return Of(std::move(soup));
}

HostileInput OneEdgeShared() {
  PolygonSoup soup = Sphere(1000, 500);
  const std::size_t first = soup.positions.size();
  Random random(3);
  for (std::size_t i = 0; i < 1'000'000; ++i) {
    soup.positions.push_back(Anywhere(random));
    AddTriangle(0, 1, first + i, soup);
  }
  return Of(std::move(soup));
}

// A million edges of 32 triangles each would not fit: 60,000 of them.
HostileInput CrowdedEdges() {
  PolygonSoup soup;
  Random random(4);
  for (std::size_t e = 0; e < 60'000; ++e) {
    const std::size_t first = soup.positions.size();
    const Vector3d at = 100.0 * Anywhere(random);
    for (int i = 0; i < 33; ++i) soup.positions.push_back(at + Anywhere(random));
    for (std::size_t i = 2; i < 33; ++i) AddTriangle(first, first + 1, first + i, soup);
  }
  return Of(std::move(soup));
}

HostileInput Coplanar() {
  PolygonSoup soup = Sphere(1000, 1000);
  for (Vector3d& p : soup.positions) p.z() = 0.0;
  return Of(std::move(soup));
}

HostileInput Needles() {
  return Of(Turned(
      500'000, 2, [](double share, double) { return std::pair(1.0, 1000.0 * share); }, true));
}

HostileInput SameCorners() {
  PolygonSoup soup = Sphere(1000, 500);
  for (std::size_t i = 0; i < 1'000'000; ++i) AddTriangle(i % 1000, i % 1000, i % 999, soup);
  return Of(std::move(soup));
}

// A ball with a face drawn out to a line of a million vertices: triangles without area, each mended
// only when its neighbour is.
HostileInput FlatFan() {
  const std::size_t count = 950'000;
  PolygonSoup soup;
  soup.positions = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  for (std::size_t i = 0; i <= count; ++i) {
    soup.positions.emplace_back(1.0 + static_cast<double>(i) / static_cast<double>(count), 0.0,
                                0.0);
  }
  // From the first vertex along the line (no area), and back from the two others.
  for (std::size_t i = 0; i < count; ++i) AddTriangle(0, 3 + i, 4 + i, soup);
  AddTriangle(0, 2, 3, soup);
  for (std::size_t i = 0; i < count; ++i) AddTriangle(3 + i, 2, 4 + i, soup);
  AddTriangle(0, 3 + count, 1, soup);
  AddTriangle(3 + count, 2, 1, soup);
  AddTriangle(0, 1, 2, soup);
  return Of(std::move(soup));
}

// A zigzag rim: every vertex lies in one place with the next, so that flat faces merge in chains.
HostileInput FlatEverywhere() {
  return Of(Turned(
      1000, 900,
      [](double share, double angle) {
        return std::pair(1.0 + 1e-13 * std::sin(1e6 * angle), std::round(20.0 * share));
      },
      true));
}

HostileInput Interlocked(double scale) {
  PolygonSoup soup = Sphere(1000, 480);
  Append(Sphere(1000, 480, scale), Vector3d(0.5, 0.0, 0.0), soup);
  return Of(std::move(soup));
}

HostileInput GiantHole() {
  return Of(Turned(
      250'000, 4,
      [](double share, double angle) {
        return std::pair(1.0 + 0.1 * std::sin(5000.0 * angle), 9.0 * share);
      },
      false));
}

// A hole of 400 edges costs most for its size: as many of them as fit.
HostileInput ManyLongHoles() {
  PolygonSoup soup;
  for (int i = 0; i < 900; ++i) {
    Append(Turned(
               390, 3, [](double share, double) { return std::pair(1.0, 5.0 * share); }, false),
           Vector3d(0.1 * i, 0.0, 0.0), soup);
  }
  return Of(std::move(soup));
}

HostileInput HalfOfTheFaces() {
  const PolygonSoup whole = Sphere(1400, 1400);
  PolygonSoup soup;
  soup.positions = whole.positions;
  Random random(5);
  for (std::size_t i = 0; i < whole.face_vertices.size(); i += 3) {
    if (random.NextUnit() < 0.5) continue;
    AddTriangle(whole.face_vertices[i], whole.face_vertices[i + 1], whole.face_vertices[i + 2],
                soup);
  }
  return Of(std::move(soup));
}

HostileInput ManyParts() {
  PolygonSoup soup = Mannequin(500'000);
  PolygonSoup small;
  small.positions = {{0, 0, 0}, {0.001, 0, 0}, {0, 0.001, 0}, {0, 0, 0.001}};
  small.face_vertices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  Random random(6);
  for (int i = 0; i < 300'000; ++i) Append(small, 2.0 * Anywhere(random), soup);
  return Of(std::move(soup));
}

HostileInput NestedShells() {
  PolygonSoup soup;
  for (int i = 0; i < 1000; ++i)
    Append(Sphere(32, 30, std::pow(0.75, i % 40)), Vector3d::Zero(), soup);
  return Of(std::move(soup));
}

// Boxes that share corners with their neighbours: every vertex is to be split.
HostileInput TouchingCorners() {
  const std::size_t n = 50;
  PolygonSoup soup;
  const auto at = [&](std::size_t x, std::size_t y, std::size_t z) {
    return (x * (n + 1) + y) * (n + 1) + z;
  };
  for (std::size_t x = 0; x <= n; ++x) {
    for (std::size_t y = 0; y <= n; ++y) {
      for (std::size_t z = 0; z <= n; ++z) {
        soup.positions.emplace_back(static_cast<double>(x), static_cast<double>(y),
                                    static_cast<double>(z));
      }
    }
  }
  for (std::size_t x = 0; x < n; ++x) {
    for (std::size_t y = 0; y < n; ++y) {
      for (std::size_t z = 0; z < n; ++z) {
        if ((x + y + z) % 2 != 0) continue;
        const std::size_t c[8] = {at(x, y, z),         at(x + 1, y, z),        at(x, y + 1, z),
                                  at(x + 1, y + 1, z), at(x, y, z + 1),        at(x + 1, y, z + 1),
                                  at(x, y + 1, z + 1), at(x + 1, y + 1, z + 1)};
        for (const auto& q :
             {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
              std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
          AddTriangle(c[q[0]], c[q[1]], c[q[2]], soup);
          AddTriangle(c[q[0]], c[q[2]], c[q[3]], soup);
        }
      }
    }
  }
  return Of(std::move(soup));
}

HostileInput Soup(double noise) {
  PolygonSoup soup = Divided(Mannequin(150'000));
  Random random(7);
  for (Vector3d& p : soup.positions) p += noise * Anywhere(random);
  PolygonSoup apart;
  for (const std::uint32_t v : soup.face_vertices) {
    apart.face_vertices.push_back(static_cast<std::uint32_t>(apart.positions.size()));
    apart.positions.push_back(soup.positions[v]);
  }
  return Of(std::move(apart));
}

// Loose triangles whose vertices all lie within a few tolerances of welding of each other.
HostileInput Clustered() {
  PolygonSoup soup = Sphere(100, 100);
  Random random(8);
  for (std::size_t i = 0; i < 600'000; ++i) {
    const std::size_t first = soup.positions.size();
    for (int k = 0; k < 3; ++k) soup.positions.push_back(1e-4 * Anywhere(random));
    AddTriangle(first, first + 1, first + 2, soup);
  }
  return Of(std::move(soup));
}

HostileInput Polygons(std::uint32_t corners, std::size_t faces) {
  PolygonSoup soup;
  Random random(9);
  for (int i = 0; i < 1'000'000; ++i) soup.positions.push_back(Anywhere(random));
  for (std::size_t f = 0; f < faces; ++f) {
    soup.face_sizes.push_back(corners);
    for (std::uint32_t k = 0; k < corners; ++k) {
      soup.face_vertices.push_back(static_cast<std::uint32_t>(random.NextBelow(1'000'000)));
    }
  }
  return Of(std::move(soup));
}

HostileInput Accordion() {
  return Of(Turned(
      1000, 900,
      [](double share, double) {
        const double fold = std::abs(std::fmod(450.0 * share, 1.0) - 0.5);
        return std::pair(0.1 + fold, share);
      },
      true));
}

HostileInput Scaled(double factor) {
  PolygonSoup soup = Mannequin(500'000);
  for (Vector3d& p : soup.positions) p *= factor;
  return Of(std::move(soup));
}

// Floats on every decimal grid but for the last vertex.
HostileInput NearlyDecimals() {
  PolygonSoup soup = Sphere(1000, 900);
  for (Vector3d& p : soup.positions) {
    for (double& x : p) x = static_cast<double>(static_cast<float>(std::round(10.0 * x) / 10.0));
  }
  soup.positions.back() = Vector3d::Constant(static_cast<double>(0.123456789F));
  return Of(std::move(soup));
}

HostileInput LargeBody() { return Of(Divided(Mannequin(300'000))); }

}  // namespace

std::vector<HostileCase> HostileArrays() {
  return {{"body, its corners not shared", LargeBody},
          {"the same, copies 2 um apart", [] { return Soup(2e-6); }},
          {"random corners", RandomCorners},
          {"random corners of 2000", RandomFewCorners},
          {"one vertex in all faces", OneVertexShared},
          {"one edge in a million faces", OneEdgeShared},
          {"32 faces at each edge", CrowdedEdges},
          {"all in one plane", Coplanar},
          {"needles round a point", Needles},
          {"a million faces a-a-b", SameCorners},
          {"a fan without area", FlatFan},
          {"nearly all without area", FlatEverywhere},
          {"two interlocked, alike", [] { return Interlocked(1.0); }},
          {"two interlocked, one smaller", [] { return Interlocked(0.7); }},
          {"holes of 250,000 edges", GiantHole},
          {"1800 holes of 390 edges", ManyLongHoles},
          {"every other face missing", HalfOfTheFaces},
          {"body and 300,000 crumbs", ManyParts},
          {"1000 nested shells", NestedShells},
          {"boxes that touch in corners", TouchingCorners},
          {"loose faces within the tolerance", Clustered},
          {"16-gons", [] { return Polygons(16, 250'000); }},
          {"64-gons, too many", [] { return Polygons(64, 500'000); }},
          {"a polygon of 100,000 corners", [] { return Polygons(100'000, 1); }},
          {"accordion", Accordion},
          {"body times 1e30", [] { return Scaled(1e30); }},
          {"body times 1e-30", [] { return Scaled(1e-30); }},
          {"nearly decimals", NearlyDecimals}};
}

}  // namespace capfit::bench
