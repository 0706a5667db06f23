#include "core/body/cleft.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace capfit::body {
namespace {

constexpr std::uint32_t kNowhere = 0xFFFFFFFFu;
// Of the region's radius: how far around a node that is the cleft its vertices are searched.
constexpr double kPatchShare = 1.0 / 6.0;

// The way from one place to another that stays farthest out.
struct Way {
  std::vector<std::uint32_t> places;  // from the first to the last
  std::size_t cleft = 0;              // index of the innermost
};

// Floods from `a`, always over the outermost place on the shore, until it arrives at `b`; the
// innermost place on the way is the cleft. `neighbours(place)` gives all, `is_open(place)` tells
// which of them are in the region.
template <typename Neighbours, typename IsOpen>
std::optional<Way> OutermostWay(std::span<const Eigen::Vector3d> points,
                                const Neighbours& neighbours, const IsOpen& is_open,
                                std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& outward) {
  std::vector<std::uint32_t> reached_from(points.size(), kNowhere);
  std::priority_queue<std::pair<double, std::uint32_t>> shore;
  shore.emplace(outward.dot(points[a]), a);
  reached_from[a] = a;
  bool is_joined = false;
  while (!shore.empty()) {
    const std::uint32_t place = shore.top().second;
    shore.pop();
    is_joined = place == b;
    if (is_joined) break;
    for (const std::uint32_t n : neighbours(place)) {
      if (reached_from[n] != kNowhere || !is_open(n)) continue;
      reached_from[n] = place;
      shore.emplace(outward.dot(points[n]), n);
    }
  }
  if (!is_joined) return std::nullopt;
  Way way = {{b}, 0};
  while (way.places.back() != a) way.places.push_back(reached_from[way.places.back()]);
  std::reverse(way.places.begin(), way.places.end());
  // (Sought on the way: of two equally low places the flood may have passed the other one first.)
  const auto height = [&](std::uint32_t place) { return outward.dot(points[place]); };
  const auto cleft = std::ranges::min_element(way.places, {}, height);
  if (*cleft == a || *cleft == b) return std::nullopt;
  way.cleft = static_cast<std::size_t>(cleft - way.places.begin());
  return way;
}

// The vertices of the nodes within a sphere, and which of them share an edge.
class Patch {
 public:
  Patch(const Shape& shape, const geometry::Sphere& sphere)
      : place_(shape.vertices.size(), kNowhere) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t node = 0; node < shape.points.size(); ++node) {
      if (geometry::SignedDistance(sphere, shape.points[node]) > 0.0) continue;
      for (const std::uint32_t v : shape.coarse->VerticesOf(node)) {
        place_[v] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(shape.vertices[v]);
        vertices.push_back(v);
      }
    }
    first_.assign(points_.size() + 2, 0);
    VisitEdges(shape, vertices, [&](std::uint32_t from, std::uint32_t) { ++first_[from + 2]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    next_.resize(first_.back());
    VisitEdges(shape, vertices,
               [&](std::uint32_t from, std::uint32_t to) { next_[first_[from + 1]++] = to; });
  }

  [[nodiscard]] std::uint32_t PlaceOf(std::uint32_t vertex) const { return place_[vertex]; }
  [[nodiscard]] std::optional<Eigen::Vector3d> Cleft(std::uint32_t a, std::uint32_t b,
                                                     const Eigen::Vector3d& outward) const {
    const auto neighbours = [this](std::uint32_t place) {
      return std::span(next_).subspan(first_[place], first_[place + 1] - first_[place]);
    };
    const auto is_open = [](std::uint32_t) { return true; };
    const std::optional<Way> way = OutermostWay(points_, neighbours, is_open, a, b, outward);
    if (!way) return std::nullopt;
    return points_[way->places[way->cleft]];
  }

 private:
  // Both ways, but for those at the rim.
  template <typename Visit>
  void VisitEdges(const Shape& shape, const std::vector<std::uint32_t>& vertices,
                  const Visit& visit) const {
    for (const std::uint32_t v : vertices) {
      for (std::uint32_t i = shape.first_triangle[v]; i < shape.first_triangle[v + 1]; ++i) {
        const mesh::Triangle& t = shape.mesh_triangles[i];
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t from = place_[t[k]];
          const std::uint32_t to = place_[t[(k + 1) % 3]];
          if (from != kNowhere && to != kNowhere) visit(from, to);
        }
      }
    }
  }

  std::vector<std::uint32_t> place_;  // of the mesh's vertices in the patch
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

std::optional<Eigen::Vector3d> FindCleft(const Shape& shape, std::uint32_t a, std::uint32_t b,
                                         const Eigen::Vector3d& outward,
                                         const geometry::Sphere& region) {
  const auto neighbours = [&](std::uint32_t node) { return shape.graph->Neighbours(node); };
  const auto is_open = [&](std::uint32_t node) {
    return geometry::SignedDistance(region, shape.points[node]) <= 0.0;
  };
  const std::optional<Way> way = OutermostWay(shape.points, neighbours, is_open, a, b, outward);
  if (!way) return std::nullopt;
  const Eigen::Vector3d cleft = shape.points[way->places[way->cleft]];
  if (shape.points.size() == shape.vertices.size()) return cleft;
  // Both ways on from there, as far as the vertices around it reach.
  const geometry::Sphere around = {cleft, kPatchShare * region.radius_m};
  const auto is_beyond = [&](std::uint32_t node) {
    return geometry::SignedDistance(around, shape.points[node]) > 0.0;
  };
  const auto middle = way->places.begin() + static_cast<std::ptrdiff_t>(way->cleft);
  const auto last = std::find_if(middle, way->places.end(), is_beyond) - 1;
  const auto first =
      std::find_if(std::make_reverse_iterator(middle), way->places.rend(), is_beyond) - 1;
  const Patch patch(shape, around);
  const auto place_of = [&](std::uint32_t node) {
    return patch.PlaceOf(shape.coarse->VerticesOf(node).front());
  };
  return patch.Cleft(place_of(*first), place_of(*last), outward).value_or(cleft);
}

}  // namespace capfit::body
