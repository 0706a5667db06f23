#include "core/skinning/surface_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>

namespace capfit::skinning {
namespace {

// Vertices are put in order by the halvings of a box around the mesh: nine times along each axis,
// to some 3 mm on a body. In the last three the normal's components are halved as well, so that
// opposite normals count like places some 3 cm apart. Before all that they are put in order by
// part: else patches between arm and trunk would hold skin of both.
constexpr int kPartBits = 4;
constexpr int kPlaceBits = 9;
constexpr int kNormalBits = 3;
// The vertex's index is in the lowest bits; meshes have at most 2 million vertices.
constexpr int kIndexBits = 22;
constexpr int kKeyBits = kPartBits + 3 * (kPlaceBits + kNormalBits) + kIndexBits;
static_assert(kKeyBits <= 64);
// Patches of so few vertices are not divided further.
constexpr std::size_t kFewVertices = 4;

// The lowest `count` bits of a number below 2^count, or of the nearest such.
std::uint32_t Bits(float value, int count) {
  const auto most = static_cast<std::int32_t>((1u << count) - 1u);
  return static_cast<std::uint32_t>(std::clamp(static_cast<std::int32_t>(value), 0, most));
}

// Bit i of `value`, which has at most ten, at bit 3 i.
std::uint64_t Spread(std::uint32_t value) {
  value = (value | value << 16) & 0x030000FFu;
  value = (value | value << 8) & 0x0300F00Fu;
  value = (value | value << 4) & 0x030C30C3u;
  return (value | value << 2) & 0x09249249u;
}

// Of each halving one bit for each axis, the first halving in the highest bits.
std::uint64_t KeyOf(const Eigen::Array4f& place, const Eigen::Array4f& normal) {
  std::uint64_t places = 0;
  std::uint64_t normals = 0;
  for (int axis = 0; axis < 3; ++axis) {
    places |= Spread(Bits(place[axis], kPlaceBits)) << axis;
    normals |= Spread(Bits(normal[axis], kNormalBits)) << axis;
  }
  constexpr int kFineBits = 3 * kNormalBits;
  std::uint64_t key = places >> kFineBits;
  for (int shift = kFineBits - 3; shift >= 0; shift -= 3) {
    key = key << 6 | (normals >> shift & 7u) << 3 | (places >> shift & 7u);
  }
  return key;
}

Eigen::Array4f Relative(const Eigen::Vector3d& position, const Eigen::Vector3d& origin) {
  Eigen::Array4f relative;
  relative << (position - origin).cast<float>(), 1.0F;
  return relative;
}

std::vector<Eigen::Array4f> SharesOf(const mesh::BodyMesh& mesh) {
  std::vector<Eigen::Array4f> shares(mesh.vertices().size(), Eigen::Array4f::Zero());
  for (const mesh::Triangle& t : mesh.triangles()) {
    const Eigen::Vector3d& a = mesh.vertices()[t[0]];
    const Eigen::Vector3f third =
        ((mesh.vertices()[t[1]] - a).cross(mesh.vertices()[t[2]] - a) * (1.0 / 6.0)).cast<float>();
    Eigen::Array4f share;
    share << third, third.norm();
    for (const std::uint32_t v : t) shares[v] += share;
  }
  return shares;
}

// Of each vertex, its index in the lowest bits.
std::vector<std::uint64_t> KeysOf(const mesh::BodyMesh& mesh,
                                  const std::vector<Eigen::Array4f>& shares,
                                  std::span<const std::uint8_t> parts) {
  constexpr auto kPlaces = static_cast<float>(1u << kPlaceBits);
  constexpr auto kHalfNormals = 0.5F * static_cast<float>(1u << kNormalBits);
  const auto per_place = kPlaces / static_cast<float>((mesh.box_max() - mesh.box_min()).maxCoeff());
  std::vector<std::uint64_t> keys(shares.size());
  for (std::size_t v = 0; v < keys.size(); ++v) {
    const float area = shares[v][3];
    const Eigen::Array4f normal =
        shares[v] * (area > 0.0F ? kHalfNormals / area : 0.0F) + kHalfNormals;
    const Eigen::Array4f place = Relative(mesh.vertices()[v], mesh.box_min()) * per_place;
    const std::uint64_t part = parts.empty() ? 0 : parts[v];
    keys[v] = (part << 3 * (kPlaceBits + kNormalBits) | KeyOf(place, normal)) << kIndexBits | v;
  }
  return keys;
}

// Eleven bits at a time, the lowest first; the index's bits are in order already.
void Sort(std::vector<std::uint64_t>& keys) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  std::vector<std::uint64_t> sorted(keys.size());
  for (int shift = kIndexBits; shift < kKeyBits; shift += kDigitBits) {
    std::array<std::uint32_t, kDigits + 1> begin{};
    for (const std::uint64_t key : keys) ++begin[(key >> shift & (kDigits - 1)) + 1];
    for (std::size_t d = 1; d < begin.size(); ++d) begin[d] += begin[d - 1];
    for (const std::uint64_t key : keys) sorted[begin[key >> shift & (kDigits - 1)]++] = key;
    keys.swap(sorted);
  }
}

// Where the highest bit in which the keys of [begin, end) differ becomes 1.
std::size_t SplitOf(const std::vector<std::uint64_t>& keys, std::size_t begin, std::size_t end) {
  const std::uint64_t bit = std::bit_floor(keys[begin] ^ keys[end - 1]);
  std::size_t low = begin;
  std::size_t high = end - 1;  // has the bit
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    ((keys[middle] & bit) != 0 ? high : low) = middle;
  }
  return high;
}

class Builder {
 public:
  Builder(const SurfaceTree& tree, const std::vector<std::uint64_t>& keys)
      : tree_(tree), keys_(keys) {
    patches_.reserve(keys.size() / 2);
  }

  std::vector<SurfacePatch> Run() && {
    Build(0, keys_.size());
    return std::move(patches_);
  }

 private:
  // At most as deep as keys have bits.
  std::int32_t Build(std::size_t begin, std::size_t end) {
    SurfacePatch patch;
    patch.begin = static_cast<std::uint32_t>(begin);
    patch.end = static_cast<std::uint32_t>(end);
    patch.is_of_one = (keys_[begin] ^ keys_[end - 1]) >> (kKeyBits - kPartBits) == 0;
    if (end - begin > kFewVertices) {
      // A single vertex is no patch: it goes with its neighbours.
      const std::size_t at = std::clamp(SplitOf(keys_, begin, end), begin + 2, end - 2);
      patch.parts[0] = Build(begin, at);
      patch.parts[1] = Build(at, end);
      Join(patch);
    } else {
      Measure(patch);
    }
    patches_.push_back(patch);
    return static_cast<std::int32_t>(patches_.size() - 1);
  }

  void Measure(SurfacePatch& patch) const {
    Eigen::Array4f moment = Eigen::Array4f::Zero();
    for (std::size_t i = patch.begin; i < patch.end; ++i) {
      const Eigen::Array4f& share = tree_.ShareOf(tree_.order()[i]);
      moment += share[3] * At(i);
      patch.area_vector += share;
      patch.square_reach = std::max(patch.square_reach, tree_.SquareReachOf(tree_.order()[i]));
    }
    patch.area = patch.area_vector[3];
    patch.area_vector[3] = 0.0F;
    patch.middle = patch.area > 0.0F ? (moment / patch.area).eval() : At(patch.begin);
    if (!(patch.area > 0.0F)) return;
    for (std::size_t i = patch.begin; i < patch.end; ++i) {
      const Eigen::Array4f& share = tree_.ShareOf(tree_.order()[i]);
      const Eigen::Array4f apart = At(i) - patch.middle;
      patch.square_radius += share[3] * apart.square().sum();
      patch.bulge += (share * apart).head<3>().sum();
    }
    patch.square_radius /= patch.area;
  }

  [[nodiscard]] Eigen::Array4f At(std::size_t i) const {
    return Relative(tree_.mesh().vertices()[tree_.order()[i]], tree_.origin());
  }

  void Join(SurfacePatch& patch) const {
    const SurfacePatch& a = patches_[patch.parts[0]];
    const SurfacePatch& b = patches_[patch.parts[1]];
    patch.area_vector = a.area_vector + b.area_vector;
    patch.area = a.area + b.area;
    patch.square_reach = std::max(a.square_reach, b.square_reach);
    const float share = patch.area > 0.0F ? b.area / patch.area : 0.5F;
    patch.middle = a.middle + share * (b.middle - a.middle);
    patch.square_radius = (1.0F - share) * a.square_radius + share * b.square_radius +
                          share * (1.0F - share) * (b.middle - a.middle).square().sum();
    patch.bulge = a.bulge + b.bulge + (a.area_vector * (a.middle - patch.middle)).sum() +
                  (b.area_vector * (b.middle - patch.middle)).sum();
  }

  const SurfaceTree& tree_;  // with all but its patches
  const std::vector<std::uint64_t>& keys_;
  std::vector<SurfacePatch> patches_;
};

}  // namespace

SurfaceTree::SurfaceTree(const mesh::BodyMesh& mesh, std::span<const std::uint8_t> parts)
    : mesh_(mesh),
      origin_(0.5 * (mesh.box_min() + mesh.box_max())),
      shares_(SharesOf(mesh)),
      square_reaches_(mesh.vertices().size()),
      half_edges_(mesh.vertices().size()),
      places_(mesh.vertices().size()) {
  mesh::HalfEdge h = 0;
  for (const mesh::Triangle& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d edge = mesh.vertices()[t[(k + 1) % 3]] - mesh.vertices()[t[k]];
      square_reaches_[t[k]] =
          std::max(square_reaches_[t[k]], static_cast<float>(edge.squaredNorm()));
      half_edges_[t[k]] = h++;
    }
  }
  std::vector<std::uint64_t> keys = KeysOf(mesh, shares_, parts);
  Sort(keys);
  order_.reserve(keys.size());
  constexpr std::uint64_t kIndex = (std::uint64_t{1} << kIndexBits) - 1;
  for (const std::uint64_t key : keys) {
    const auto vertex = static_cast<std::uint32_t>(key & kIndex);
    places_[vertex] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(vertex);
  }
  patches_ = Builder(*this, keys).Run();
}

}  // namespace capfit::skinning
