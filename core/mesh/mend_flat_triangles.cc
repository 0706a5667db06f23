#include "core/mesh/mend_flat_triangles.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <iterator>

namespace capfit::mesh {
namespace {

// Looks at triangles and steps round vertices that one mesh may take: bounds what a wheel of flat
// triangles can cost.
constexpr std::size_t kMostMendingSteps = 20'000'000;

constexpr std::uint32_t kDead = 0xFFFFFFFFu;

class FlatTriangleMender {
 public:
  FlatTriangleMender(std::span<const Eigen::Vector3d> positions, double tolerance, Surface& surface)
      : positions_(positions), tolerance_(tolerance), surface_(surface) {
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      if (IsFlat(positions, surface.triangles[t], tolerance)) flat_.push_back(t);
    }
  }

  // Each success leaves fewer flat triangles, so this ends.
  MendedTriangles Run() {
    for (bool mended = true; mended && steps_left_ > 0;) {
      mended = false;
      for (const std::uint32_t t : flat_) mended |= MendFrom(t);
    }
    if (!result_.merged.empty()) RemoveDead();
    return std::move(result_);
  }

 private:
  // The triangle, and what its neighbours make of that: a long row of flat triangles is mended in
  // one go, from whichever end there is a way.
  bool MendFrom(std::uint32_t first) {
    bool mended = false;
    open_.push_back(first);
    while (!open_.empty() && steps_left_ > 0) {
      const std::uint32_t t = open_.back();
      open_.pop_back();
      --steps_left_;
      mended |= IsStillFlat(t) && Mend(t);
    }
    return mended;
  }

  [[nodiscard]] bool IsStillFlat(std::uint32_t t) const {
    return surface_.triangles[t][0] != kDead &&
           IsFlat(positions_, surface_.triangles[t], tolerance_);
  }
  [[nodiscard]] std::uint32_t Start(HalfEdge h) const { return StartOf(surface_.triangles, h); }
  [[nodiscard]] std::uint32_t Apex(HalfEdge h) const { return Start(PreviousInTriangle(h)); }
  [[nodiscard]] double LengthOf(HalfEdge h) const {
    return (positions_[Start(NextInTriangle(h))] - positions_[Start(h)]).norm();
  }

  bool Mend(std::uint32_t t) {
    HalfEdge shortest = 3 * t;
    HalfEdge longest = 3 * t;
    for (HalfEdge h = 3 * t + 1; h < 3 * t + 3; ++h) {
      if (LengthOf(h) < LengthOf(shortest)) shortest = h;
      if (LengthOf(h) > LengthOf(longest)) longest = h;
    }
    return LengthOf(shortest) <= tolerance_ ? Merge(shortest) : Flip(longest);
  }

  // The vertices round the start of `first`, each joined to it by an edge.
  std::vector<std::uint32_t> Ring(HalfEdge first) {
    std::vector<std::uint32_t> ring;
    HalfEdge h = first;
    do {
      ring.push_back(Start(NextInTriangle(h)));
      h = surface_.mate[PreviousInTriangle(h)];
    } while (h != first && ring.size() < steps_left_);
    steps_left_ -= std::min(ring.size(), steps_left_);
    std::sort(ring.begin(), ring.end());
    return ring;
  }

  // (a, b, c) and (b, a, d) become (a, d, c) and (d, b, c).
  bool Flip(HalfEdge h) {
    const HalfEdge m = surface_.mate[h];
    const std::uint32_t a = Start(h);
    const std::uint32_t b = Start(m);
    const std::uint32_t c = Apex(h);
    const std::uint32_t d = Apex(m);
    if (c == d || IsFlat(positions_, {a, d, c}, tolerance_) ||
        IsFlat(positions_, {d, b, c}, tolerance_)) {
      return false;
    }
    const std::vector<std::uint32_t> ring = Ring(PreviousInTriangle(h));
    if (steps_left_ == 0 || std::binary_search(ring.begin(), ring.end(), d)) return false;
    const HalfEdge t0 = h / 3 * 3;
    const HalfEdge m0 = m / 3 * 3;
    const HalfEdge beside_ad = surface_.mate[NextInTriangle(m)];
    const HalfEdge beside_db = surface_.mate[PreviousInTriangle(m)];
    const HalfEdge beside_bc = surface_.mate[NextInTriangle(h)];
    const HalfEdge beside_ca = surface_.mate[PreviousInTriangle(h)];
    surface_.triangles[h / 3] = {a, d, c};
    surface_.triangles[m / 3] = {d, b, c};
    Join(t0, beside_ad);
    Join(t0 + 1, m0 + 2);
    Join(t0 + 2, beside_ca);
    Join(m0, beside_db);
    Join(m0 + 1, beside_bc);
    for (const HalfEdge beside : {beside_ad, beside_db, beside_bc, beside_ca}) {
      open_.push_back(beside / 3);
    }
    ++result_.flipped;
    return true;
  }

  // Both triangles of the edge vanish; its end with the higher number gives way.
  bool Merge(HalfEdge h) {
    if (Start(surface_.mate[h]) < Start(h)) h = surface_.mate[h];
    const HalfEdge m = surface_.mate[h];
    const std::uint32_t kept = Start(h);
    const std::uint32_t gone = Start(m);
    // The two may share the two neighbours across the edge and no other, and not be all there is
    // (a tetrahedron), or the surface would fold onto itself.
    const std::vector<std::uint32_t> ring = Ring(h);
    const std::vector<std::uint32_t> ring_of_gone = Ring(m);
    std::vector<std::uint32_t> common;
    std::set_intersection(ring.begin(), ring.end(), ring_of_gone.begin(), ring_of_gone.end(),
                          std::back_inserter(common));
    if (steps_left_ == 0 || common.size() != 2 || ring.size() + ring_of_gone.size() < 7) {
      return false;
    }
    HalfEdge round = m;
    do {
      surface_.triangles[round / 3][round % 3] = kept;
      open_.push_back(round / 3);
      round = surface_.mate[PreviousInTriangle(round)];
    } while (round != m);
    Join(surface_.mate[NextInTriangle(h)], surface_.mate[PreviousInTriangle(h)]);
    Join(surface_.mate[NextInTriangle(m)], surface_.mate[PreviousInTriangle(m)]);
    surface_.triangles[h / 3] = surface_.triangles[m / 3] = {kDead, kDead, kDead};
    result_.merged.emplace_back(gone, kept);
    return true;
  }

  void Join(HalfEdge a, HalfEdge b) {
    surface_.mate[a] = b;
    surface_.mate[b] = a;
  }

  void RemoveDead() {
    std::vector<std::uint32_t> new_index(surface_.triangles.size(), kDead);
    std::uint32_t kept = 0;
    for (std::size_t t = 0; t < new_index.size(); ++t) {
      if (surface_.triangles[t][0] != kDead) new_index[t] = kept++;
    }
    for (std::size_t t = 0; t < new_index.size(); ++t) {
      if (new_index[t] == kDead) continue;
      surface_.triangles[new_index[t]] = surface_.triangles[t];
      for (int k = 0; k < 3; ++k) {
        const HalfEdge mate = surface_.mate[3 * t + k];
        surface_.mate[3 * new_index[t] + k] = 3 * new_index[mate / 3] + mate % 3;
      }
    }
    surface_.triangles.resize(kept);
    surface_.mate.resize(3 * std::size_t{kept});
  }

  std::span<const Eigen::Vector3d> positions_;
  double tolerance_;
  Surface& surface_;
  std::vector<std::uint32_t> flat_;
  std::vector<std::uint32_t> open_;  // to be looked at next
  std::size_t steps_left_ = kMostMendingSteps;
  MendedTriangles result_;
};

}  // namespace

bool IsFlat(std::span<const Eigen::Vector3d> positions, const Triangle& triangle,
            double tolerance) {
  const Eigen::Vector3d ab = positions[triangle[1]] - positions[triangle[0]];
  const Eigen::Vector3d ac = positions[triangle[2]] - positions[triangle[0]];
  const double longest_squared =
      std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  // The height on the longest edge is twice the area through its length.
  return ab.cross(ac).squaredNorm() <= tolerance * tolerance * longest_squared;
}

MendedTriangles MendFlatTriangles(std::span<const Eigen::Vector3d> positions, double tolerance,
                                  Surface& surface) {
  return FlatTriangleMender(positions, tolerance, surface).Run();
}

}  // namespace capfit::mesh
