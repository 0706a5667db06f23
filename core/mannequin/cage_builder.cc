#include "core/mannequin/cage_builder.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;

// The vertices of a cap, (width + 1) x (height + 1), row by row.
struct Grid {
  int width;
  int height;
  Ring vertices;
  [[nodiscard]] std::uint32_t& at(int a, int b) { return vertices[b * (width + 1) + a]; }
};

// Puts the ring around the grid, starting with the side b == 0.
void LayBorder(const Ring& ring, Grid& grid) {
  std::size_t next = 0;
  for (int a = 0; a < grid.width; ++a) grid.at(a, 0) = ring[next++];
  for (int b = 0; b < grid.height; ++b) grid.at(grid.width, b) = ring[next++];
  for (int a = grid.width; a > 0; --a) grid.at(a, grid.height) = ring[next++];
  for (int b = grid.height; b > 0; --b) grid.at(0, b) = ring[next++];
}

}  // namespace

std::uint32_t CageBuilder::Add(const Vector3d& position) {
  mesh_.vertices.push_back(position);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void CageBuilder::BridgeColumn(const Ring& from, const Ring& to, std::size_t k) {
  const std::size_t next = (k + 1) % from.size();
  AddQuad({from[k], to[k], to[next], from[next]});
}

void CageBuilder::Bridge(const Ring& from, const Ring& to, bool closed) {
  assert(from.size() == to.size());
  const std::size_t columns = closed ? from.size() : from.size() - 1;
  for (std::size_t k = 0; k < columns; ++k) BridgeColumn(from, to, k);
}

void CageBuilder::Cap(const Ring& ring, int width, int height, const Vector3d& bulge) {
  assert(std::cmp_equal(ring.size(), 2 * (width + height)));
  Grid grid{width, height, Ring((width + 1) * (height + 1))};
  LayBorder(ring, grid);
  const auto p = [&](int a, int b) { return position(grid.at(a, b)); };
  for (int b = 1; b < height; ++b) {
    for (int a = 1; a < width; ++a) {
      const double u = static_cast<double>(a) / width;
      const double v = static_cast<double>(b) / height;
      const Vector3d sides =
          (1 - v) * p(a, 0) + v * p(a, height) + (1 - u) * p(0, b) + u * p(width, b);
      const Vector3d corners = (1 - v) * ((1 - u) * p(0, 0) + u * p(width, 0)) +
                               v * ((1 - u) * p(0, height) + u * p(width, height));
      const double rise = std::sin(std::numbers::pi * u) * std::sin(std::numbers::pi * v);
      grid.at(a, b) = Add(sides - corners + rise * bulge);
    }
  }
  for (int b = 0; b < height; ++b) {
    for (int a = 0; a < width; ++a) {
      AddQuad({grid.at(a, b), grid.at(a, b + 1), grid.at(a + 1, b + 1), grid.at(a + 1, b)});
    }
  }
}

void CageBuilder::Crease(const Ring& ring, bool closed) {
  const std::size_t edges = closed ? ring.size() : ring.size() - 1;
  for (std::size_t k = 0; k < edges; ++k) {
    mesh_.creases.push_back({ring[k], ring[(k + 1) % ring.size()]});
  }
}

}  // namespace capfit::mannequin
