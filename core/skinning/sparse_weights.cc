#include "core/skinning/sparse_weights.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/skinning/linear_precision.h"
#include "core/skinning/patch_weights.h"
#include "core/skinning/surface_tree.h"

namespace capfit::skinning {
namespace {

// What weights of a group get at least of a change that all share, as a share of the mean size.
constexpr double kLeastShare = 0.02;
// Keeps a group from tilting steeply to mend what its vertices, nearly in one plane, cannot.
constexpr double kStiffness = 1e-3;
constexpr double kPartStiffness = 1e-6;
// Below this share of the absolute sum, a sum of weights is noise and must not be divided by.
constexpr double kUsableRowSum = 1e-9;
constexpr std::size_t kVerticesLookedAt = 12;

// Which of the caller's vertices can carry what the mesh's vertices weigh, and where they are.
class SparseCarriers {
 public:
  SparseCarriers(const mesh::BodyMesh& mesh, const std::optional<Carriers>& carriers)
      : positions_(carriers ? carriers->positions_m : mesh.vertices()),
        of_mesh_vertex_(carriers ? carriers->of_mesh_vertex : std::span<const std::uint32_t>()),
        source_(positions_.size(), -1) {
    const std::span<const std::int32_t> of_source =
        carriers ? carriers->carrier_of_source : mesh.vertex_of_source();
    for (std::size_t s = of_source.size(); s-- > 0;) {
      if (of_source[s] >= 0) source_[of_source[s]] = static_cast<std::int32_t>(s);
    }
  }

  [[nodiscard]] bool MayCarry(std::size_t mesh_vertex) const {
    return source_[CarrierOf(mesh_vertex)] >= 0;
  }
  [[nodiscard]] std::size_t CarrierOf(std::size_t mesh_vertex) const {
    return of_mesh_vertex_.empty() ? mesh_vertex : of_mesh_vertex_[mesh_vertex];
  }
  [[nodiscard]] const Eigen::Vector3d& position(std::size_t carrier) const {
    return positions_[carrier];
  }
  // Of its welded copies the first.
  [[nodiscard]] std::int32_t source(std::size_t carrier) const { return source_[carrier]; }

 private:
  std::span<const Eigen::Vector3d> positions_;
  std::span<const std::uint32_t> of_mesh_vertex_;
  std::vector<std::int32_t> source_;
};

struct Entry {
  std::uint32_t source = 0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // from the centre
  double weight = 0.0;
};

Eigen::Vector4d MomentsOf(const Eigen::Vector3d& offset) {
  return {1.0, offset.x(), offset.y(), offset.z()};
}

// How much each weight may be changed, in relation to the others.
std::vector<double> GroupShares(std::span<const Entry> entries) {
  double sizes = 0.0;
  for (const Entry& entry : entries) sizes += std::abs(entry.weight);
  const double least = kLeastShare * sizes / static_cast<double>(entries.size());
  std::vector<double> shares;
  shares.reserve(entries.size());
  for (const Entry& entry : entries) shares.push_back(std::abs(entry.weight) + least);
  return shares;
}

// The same for a whole part of the body, or row: less where it is farther than the weights' mean
// distance, else long levers would do all of it, and a little weight on a far part of the body
// moves the centre much.
std::vector<double> RowShares(std::span<const Entry> entries) {
  double sizes = 0.0;
  double distances = 0.0;
  for (const Entry& entry : entries) {
    sizes += std::abs(entry.weight);
    distances += std::abs(entry.weight) * entry.offset.norm();
  }
  const double square = distances > 0.0 ? std::pow(sizes / distances, 2) : 0.0;
  std::vector<double> shares;
  shares.reserve(entries.size());
  for (const Entry& entry : entries) {
    shares.push_back(std::abs(entry.weight) / (1.0 + square * entry.offset.squaredNorm()));
  }
  return shares;
}

// Changes the weights of `entries` by share_i (a + b . q_i) so that they sum to `weight` and their
// moment is `moment`; with stiffness, only nearly.
void Mend(std::span<Entry> entries, const std::vector<double>& shares, double weight,
          const Eigen::Vector3d& moment, double stiffness) {
  if (entries.size() == 1) {
    entries.front().weight = weight;
    return;
  }
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Entry& entry : entries) middle += entry.offset;
  middle /= static_cast<double>(entries.size());
  double extent = 0.0;
  for (const Entry& entry : entries) {
    extent = std::max(extent, (entry.offset - middle).squaredNorm());
  }
  const double inverse = extent > 0.0 ? 1.0 / std::sqrt(extent) : 0.0;
  Eigen::Matrix4d supply = Eigen::Matrix4d::Zero();
  Eigen::Vector4d missing = MomentsOf(inverse * (moment - weight * middle));
  missing[0] = weight;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Eigen::Vector4d m = MomentsOf(inverse * (entries[i].offset - middle));
    supply += shares[i] * m * m.transpose();
    missing -= entries[i].weight * m;
  }
  if (!(supply(0, 0) > 0.0)) return;
  supply.diagonal().array() += stiffness * supply(0, 0);
  const Eigen::Vector4d change =
      stiffness > 0.0 ? Eigen::Vector4d(supply.ldlt().solve(missing))
                      : Eigen::Vector4d(supply.completeOrthogonalDecomposition().solve(missing));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Eigen::Vector4d m = MomentsOf(inverse * (entries[i].offset - middle));
    entries[i].weight += shares[i] * change.dot(m);
  }
}

// Of the patch's vertices that may carry the one nearest to where its weight lies; of large patches
// only some are looked at. Nothing where none may.
std::optional<std::uint32_t> CarryingVertex(const SeenPatch& seen, const Eigen::Vector3d& center,
                                            const SurfaceTree& tree,
                                            const SparseCarriers& carriers) {
  const Eigen::Vector3d middle = center + seen.moment / seen.weight;
  const std::size_t count = seen.end - seen.begin;
  for (std::size_t step = 1 + count / kVerticesLookedAt; step > 0; step /= 2) {
    std::optional<std::uint32_t> found;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = seen.begin + step / 2; i < seen.end; i += step) {
      const std::uint32_t vertex = tree.order()[i];
      const double distance = (tree.mesh().vertices()[vertex] - middle).squaredNorm();
      if (!(distance < nearest) || !carriers.MayCarry(vertex)) continue;
      nearest = distance;
      found = vertex;
    }
    if (found) return found;
  }
  return std::nullopt;
}

// Patches that are mended together: their sum and moment.
struct Target {
  double weight = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  std::size_t first = 0;  // of their entries

  void Add(const SeenPatch& seen) {
    weight += seen.weight;
    moment += seen.moment;
  }
};

// The entries of one centre, in the order of patches. Groups first, then parts of the body: of a
// group with few patches the moment cannot be mended.
std::vector<Entry> EntriesOf(const Eigen::Vector3d& center, const SurfaceTree& tree,
                             const SparseCarriers& carriers) {
  const std::vector<SeenPatch> seen =
      PatchesSeenFrom(center, tree, {kLeastSparseWeights, kMostSparseWeights});
  std::vector<Entry> entries;
  entries.reserve(seen.size());
  Target group;
  Target part;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    group.Add(seen[i]);
    part.Add(seen[i]);
    if (const auto vertex = CarryingVertex(seen[i], center, tree, carriers)) {
      const std::size_t carrier = carriers.CarrierOf(*vertex);
      entries.push_back({static_cast<std::uint32_t>(carriers.source(carrier)),
                         carriers.position(carrier) - center, seen[i].weight});
    }
    const bool is_last = i + 1 == seen.size();
    if (is_last || seen[i + 1].group != seen[i].group) {
      const std::span<Entry> of_group = std::span(entries).subspan(group.first);
      if (!of_group.empty()) {
        Mend(of_group, GroupShares(of_group), group.weight, group.moment, kStiffness);
      }
      group = {0.0, Eigen::Vector3d::Zero(), entries.size()};
    }
    if (is_last || seen[i + 1].part != seen[i].part) {
      const std::span<Entry> of_part = std::span(entries).subspan(part.first);
      if (!of_part.empty()) {
        Mend(of_part, RowShares(of_part), part.weight, part.moment, kPartStiffness);
      }
      part = {0.0, Eigen::Vector3d::Zero(), entries.size()};
    }
  }
  return entries;
}

// Patches whose vertices are carried by the same one.
void Merge(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.source < b.source; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (kept > 0 && entries[kept - 1].source == entries[i].source) {
      entries[kept - 1].weight += entries[i].weight;
    } else {
      entries[kept++] = entries[i];
    }
  }
  entries.resize(kept);
}

void DivideBySum(std::span<Entry> entries) {
  double sum = 0.0;
  double sizes = 0.0;
  for (const Entry& entry : entries) {
    sum += entry.weight;
    sizes += std::abs(entry.weight);
  }
  const bool is_usable = std::abs(sum) > kUsableRowSum * sizes;
  for (Entry& entry : entries) {
    entry.weight = is_usable ? entry.weight / sum : std::abs(entry.weight) / sizes;
  }
}

struct Row {
  std::vector<std::uint32_t> vertices;
  std::vector<float> weights;
};

Row RowOf(const Eigen::Vector3d& center, const SurfaceTree& tree, const SparseCarriers& carriers) {
  std::vector<Entry> entries = EntriesOf(center, tree, carriers);
  Merge(entries);
  DivideBySum(entries);
  Mend(entries, RowShares(entries), 1.0, Eigen::Vector3d::Zero(), 0.0);
  std::vector<Eigen::Vector3d> offsets;
  std::vector<double> weights;
  Row row;
  for (const Entry& entry : entries) {
    if (entry.weight == 0.0) continue;
    row.vertices.push_back(entry.source);
    offsets.push_back(entry.offset);
    weights.push_back(entry.weight);
  }
  row.weights = RoundPrecisely(offsets, weights);
  return row;
}

}  // namespace

SparseWeights SparseMeanValueWeights(const mesh::BodyMesh& mesh,
                                     std::span<const Eigen::Vector3d> centers_m,
                                     const ThreadPool& pool, const FitObserver& observer,
                                     std::span<const std::uint8_t> parts,
                                     const std::optional<Carriers>& carriers) {
  const SparseCarriers sparse(mesh, carriers);
  const SurfaceTree tree(mesh, parts);
  std::vector<Row> rows(centers_m.size());
  pool.ForEach(rows.size(), [&](std::size_t i) {
    if (!observer.IsCancelled()) rows[i] = RowOf(centers_m[i], tree, sparse);
  });
  SparseWeights result;
  result.vertex_count = (carriers ? carriers->carrier_of_source : mesh.vertex_of_source()).size();
  for (const Row& row : rows) {
    result.vertices.insert(result.vertices.end(), row.vertices.begin(), row.vertices.end());
    result.weights.insert(result.weights.end(), row.weights.begin(), row.weights.end());
    result.row_ends.push_back(static_cast<std::uint32_t>(result.vertices.size()));
  }
  return result;
}

void MakeExact(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3d> centers,
               SparseWeights& weights) {
  for (std::size_t s = 0; s < weights.sphere_count(); ++s) {
    std::vector<Eigen::Vector3d> offsets;
    std::vector<double> row;
    for (std::size_t i = weights.RowBegin(s); i < weights.row_ends[s]; ++i) {
      offsets.emplace_back(vertices[weights.vertices[i]] - centers[s]);
      row.push_back(weights.weights[i]);
    }
    const std::vector<float> exact = RoundPrecisely(offsets, row);
    std::copy(exact.begin(), exact.end(),
              weights.weights.begin() + static_cast<std::ptrdiff_t>(weights.RowBegin(s)));
  }
}

std::vector<Eigen::Vector3d> Apply(const SparseWeights& weights,
                                   std::span<const Eigen::Vector3d> vertices) {
  assert(vertices.size() == weights.vertex_count);
  std::vector<Eigen::Vector3d> centers(weights.sphere_count(), Eigen::Vector3d::Zero());
  if (vertices.empty()) return centers;
  for (std::size_t s = 0; s < centers.size(); ++s) {
    const std::size_t begin = weights.RowBegin(s);
    if (begin == weights.row_ends[s]) continue;
    // Relative to one of them: what the sum lacks to 1 is then not multiplied by the distance from
    // the origin.
    const Eigen::Vector3d origin = vertices[weights.vertices[begin]];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = begin; i < weights.row_ends[s]; ++i) {
      sum += static_cast<double>(weights.weights[i]) * (vertices[weights.vertices[i]] - origin);
    }
    centers[s] = origin + sum;
  }
  return centers;
}

}  // namespace capfit::skinning
