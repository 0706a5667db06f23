#include "core/mesh/surface_parts.h"

#include <Eigen/Geometry>  // cross
#include <utility>

namespace capfit::mesh {
namespace {

constexpr std::uint32_t kNoPart = 0xFFFFFFFFu;

// Turning (a, b, c) into (a, c, b) makes half-edge k of the triangle half-edge 2 - k.
HalfEdge AfterTurn(HalfEdge h, const std::vector<char>& turned) {
  if (h == kNoMate || turned[h / 3] == 0) return h;
  return 3 * (h / 3) + 2 - h % 3;
}

void TurnTriangles(const std::vector<char>& turned, Surface& surface) {
  RawVector<HalfEdge> mate(surface.mate.size());
  for (HalfEdge h = 0; h < mate.size(); ++h) {
    mate[AfterTurn(h, turned)] = AfterTurn(surface.mate[h], turned);
  }
  surface.mate = std::move(mate);
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (turned[t] != 0) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  }
}

// Walks each part from its first triangle.
class PartWalker {
 public:
  explicit PartWalker(Surface& surface) : surface_(surface), turned_(surface.triangles.size(), 0) {
    found_.part_of_triangle.assign(surface.triangles.size(), kNoPart);
  }

  SurfaceParts Run() {
    std::size_t turned = 0;
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      if (found_.part_of_triangle[t] != kNoPart) continue;
      WalkFrom(t);
      turned += found_.parts.back().turned;
    }
    if (turned > 0) TurnTriangles(turned_, surface_);
    return std::move(found_);
  }

 private:
  void WalkFrom(std::uint32_t first) {
    const auto part = static_cast<std::uint32_t>(found_.parts.size());
    found_.parts.emplace_back();
    found_.part_of_triangle[first] = part;
    stack_.push_back(first);
    while (!stack_.empty()) {
      const std::uint32_t t = stack_.back();
      stack_.pop_back();
      ++found_.parts.back().triangles;
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) Cross(h, part);
    }
  }

  void Cross(HalfEdge h, std::uint32_t part) {
    const HalfEdge mate = surface_.mate[h];
    if (mate == kNoMate) {
      ++found_.parts.back().open_edges;
      return;
    }
    const bool same_way = StartOf(surface_.triangles, h) == StartOf(surface_.triangles, mate);
    const char wanted = static_cast<char>(turned_[h / 3] ^ static_cast<char>(same_way));
    if (found_.part_of_triangle[mate / 3] == kNoPart) {
      found_.part_of_triangle[mate / 3] = part;
      turned_[mate / 3] = wanted;
      found_.parts.back().turned += wanted != 0;
      stack_.push_back(mate / 3);
    } else if (turned_[mate / 3] != wanted) {
      surface_.mate[h] = surface_.mate[mate] = kNoMate;
      ++found_.parts.back().conflicts;
      ++found_.parts.back().open_edges;
    }
  }

  Surface& surface_;
  SurfaceParts found_;
  std::vector<char> turned_;
  std::vector<std::uint32_t> stack_;
};

// Sums over one part, relative to a vertex of the mesh so that far meshes keep their digits.
struct PartSums {
  double volume = 0.0;
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero();
  Eigen::Vector3d open_starts = Eigen::Vector3d::Zero();
  double open_edges = 0.0;
};

void MeasureVolumes(std::span<const Eigen::Vector3d> positions, const Surface& surface,
                    SurfaceParts& parts) {
  if (surface.triangles.empty()) return;
  const Eigen::Vector3d origin = positions[surface.triangles.front()[0]];
  std::vector<PartSums> sums(parts.parts.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    PartSums& part = sums[parts.part_of_triangle[t]];
    const Eigen::Vector3d a = positions[triangle[0]] - origin;
    const Eigen::Vector3d ab = positions[triangle[1]] - positions[triangle[0]];
    const Eigen::Vector3d ac = positions[triangle[2]] - positions[triangle[0]];
    const Eigen::Vector3d area_vector = 0.5 * ab.cross(ac);
    part.volume += a.dot(area_vector) / 3.0;
    part.area_vector += area_vector;
    for (int k = 0; k < 3; ++k) {
      if (surface.mate[3 * t + k] != kNoMate) continue;
      part.open_starts += positions[triangle[k]] - origin;
      part.open_edges += 1.0;
    }
  }
  for (std::size_t p = 0; p < sums.size(); ++p) {
    double volume = sums[p].volume;
    if (sums[p].open_edges > 0.0) {
      // The cones from a tip over the open edges add what moving the origin there changes.
      volume -= sums[p].open_starts.dot(sums[p].area_vector) / sums[p].open_edges / 3.0;
    }
    parts.parts[p].volume = volume;
  }
}

}  // namespace

SurfaceParts OrientParts(std::span<const Eigen::Vector3d> positions, Surface& surface) {
  SurfaceParts parts = PartWalker(surface).Run();
  MeasureVolumes(positions, surface, parts);
  return parts;
}

void KeepPart(const SurfaceParts& parts, std::uint32_t part, Surface& surface) {
  std::vector<std::uint32_t> new_index(surface.triangles.size(), kNoPart);
  std::uint32_t kept = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (parts.part_of_triangle[t] == part) new_index[t] = kept++;
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (new_index[t] == kNoPart) continue;
    surface.triangles[new_index[t]] = surface.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const HalfEdge mate = surface.mate[3 * t + k];
      surface.mate[3 * new_index[t] + k] =
          mate == kNoMate ? kNoMate : 3 * new_index[mate / 3] + mate % 3;
    }
  }
  surface.triangles.resize(kept);
  surface.mate.resize(3 * std::size_t{kept});
}

void TurnInsideOut(Surface& surface) {
  TurnTriangles(std::vector<char>(surface.triangles.size(), 1), surface);
}

}  // namespace capfit::mesh
