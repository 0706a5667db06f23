#include "core/skinning/mean_value_coordinates.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

#include "core/skinning/linear_precision.h"
#include "core/skinning/spherical_triangles.h"

namespace capfit::skinning {
namespace {

// How weights of mesh vertices become weights of the caller's vertices.
class SourceMap {
 public:
  explicit SourceMap(const mesh::BodyMesh& mesh)
      : SourceMap(mesh.vertex_of_source(), mesh.vertices().size()) {
    FindPassedOn(mesh);
  }

  SourceMap(std::span<const std::int32_t> vertex_of_source, std::size_t vertices)
      : vertex_of_source_(vertex_of_source), share_(vertices, 0.0) {
    for (const std::int32_t vertex : vertex_of_source_) {
      if (vertex >= 0) share_[vertex] += 1.0;
    }
    for (double& share : share_) share = share > 0.0 ? 1.0 / share : 0.0;
  }

  [[nodiscard]] std::span<const std::int32_t> vertex_of_source() const { return vertex_of_source_; }
  // What one copy of the vertex gets: 1 / number of copies, 0 where the caller has none.
  [[nodiscard]] double share(std::size_t vertex) const { return share_[vertex]; }

  // Moves the weight of vertices that the caller does not have to their neighbours.
  void PassOn(std::vector<Lanes>& weights) const {
    for (const PassedOn& passed : passed_on_) {
      if (passed.neighbours.empty()) continue;
      const Lanes part = weights[passed.vertex] / static_cast<double>(passed.neighbours.size());
      for (const std::uint32_t neighbour : passed.neighbours) weights[neighbour] += part;
      weights[passed.vertex] = Lanes::Zero();
    }
  }

 private:
  struct PassedOn {
    std::uint32_t vertex = 0;
    std::vector<std::uint32_t> neighbours;
  };

  void FindPassedOn(const mesh::BodyMesh& mesh) {
    std::vector<std::int32_t> slot(share_.size(), -1);
    for (std::size_t vertex = 0; vertex < share_.size(); ++vertex) {
      if (share_[vertex] > 0.0) continue;
      slot[vertex] = static_cast<std::int32_t>(passed_on_.size());
      passed_on_.push_back({static_cast<std::uint32_t>(vertex), {}});
    }
    if (passed_on_.empty()) return;
    for (const mesh::Triangle& triangle : mesh.triangles()) {
      for (std::size_t k = 0; k < 3; ++k) {
        // The mesh is closed: the next corner over all triangles runs through all neighbours.
        const std::uint32_t next = triangle[(k + 1) % 3];
        const std::int32_t at = slot[triangle[k]];
        if (at < 0 || share_[next] == 0.0) continue;
        passed_on_[at].neighbours.push_back(next);
      }
    }
  }

  std::span<const std::int32_t> vertex_of_source_;
  std::vector<double> share_;
  std::vector<PassedOn> passed_on_;
};

std::span<float> MutableRow(DenseWeights& weights, std::size_t sphere) {
  return std::span(weights.weights).subspan(sphere * weights.vertex_count, weights.vertex_count);
}

// The weights of a centre on the surface, as weights of all mesh vertices.
void PutHit(const SurfaceHit& hit, int lane, std::vector<Lanes>& weights) {
  for (Lanes& weight : weights) weight[lane] = 0.0;
  for (std::size_t k = 0; k < 3; ++k) weights[hit.vertices[k]][lane] += hit.weights[k];
}

// Rows of up to four centres, starting with `first`.
void FillRows(const mesh::BodyMesh& mesh, const SourceMap& sources,
              const std::optional<Carriers>& carriers, std::span<const Eigen::Vector3d> centers,
              std::size_t first, DenseWeights& result) {
  const std::size_t count = std::min<std::size_t>(kLanes, centers.size() - first);
  std::array<Eigen::Vector3d, kLanes> batch;
  for (std::size_t k = 0; k < kLanes; ++k) batch[k] = centers[first + std::min(k, count - 1)];

  RawWeights raw = MeanValueRawWeights(mesh, batch);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (raw.hits[lane]) PutHit(*raw.hits[lane], lane, raw.weights);
  }
  if (carriers) {
    std::vector<Lanes> carried(carriers->positions_m.size(), Lanes::Zero());
    for (std::size_t v = 0; v < raw.weights.size(); ++v) {
      carried[carriers->of_mesh_vertex[v]] += raw.weights[v];
    }
    raw.weights = std::move(carried);
  } else {
    sources.PassOn(raw.weights);
  }
  MakeLinearlyPrecise(carriers ? carriers->positions_m : mesh.vertices(), batch, raw.weights);

  const std::span<const std::int32_t> vertex_of_source = sources.vertex_of_source();
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<float> row = MutableRow(result, first + k);
    for (std::size_t s = 0; s < row.size(); ++s) {
      const std::int32_t vertex = vertex_of_source[s];
      if (vertex < 0) continue;
      row[s] = static_cast<float>(sources.share(vertex) *
                                  raw.weights[vertex][static_cast<Eigen::Index>(k)]);
    }
    MendFloatSum(row);
  }
}

}  // namespace

DenseWeights MeanValueWeights(const mesh::BodyMesh& mesh,
                              std::span<const Eigen::Vector3d> centers_m, const ThreadPool& pool,
                              const FitObserver& observer,
                              const std::optional<Carriers>& carriers) {
  const SourceMap sources =
      carriers ? SourceMap(carriers->carrier_of_source, carriers->positions_m.size())
               : SourceMap(mesh);
  DenseWeights result;
  result.sphere_count = centers_m.size();
  result.vertex_count = sources.vertex_of_source().size();
  result.weights.assign(result.sphere_count * result.vertex_count, 0.0f);
  const std::size_t batches = (centers_m.size() + kLanes - 1) / kLanes;
  pool.ForEach(batches, [&](std::size_t batch) {
    if (observer.IsCancelled()) return;
    FillRows(mesh, sources, carriers, centers_m, batch * kLanes, result);
  });
  return result;
}

std::vector<Eigen::Vector3d> Apply(const DenseWeights& weights,
                                   std::span<const Eigen::Vector3d> vertices,
                                   const ThreadPool& pool) {
  assert(vertices.size() == weights.vertex_count);
  assert(weights.weights.size() == weights.sphere_count * weights.vertex_count);
  std::vector<Eigen::Vector3d> centers(weights.sphere_count, Eigen::Vector3d::Zero());
  if (vertices.empty()) return centers;
  // Relative to one vertex: what a row's sum lacks to 1 is then not multiplied by the distance from
  // the origin.
  const Eigen::Vector3d origin = vertices.front();
  pool.ForEach((centers.size() + kLanes - 1) / kLanes, [&](std::size_t batch) {
    const std::size_t first = batch * kLanes;
    const std::size_t count = std::min<std::size_t>(kLanes, centers.size() - first);
    std::array<const float*, kLanes> rows{};
    for (std::size_t k = 0; k < kLanes; ++k) {
      rows[k] = weights.Row(first + std::min(k, count - 1)).data();
    }
    std::array<Lanes, kLanes> sums;  // x, y, z and a number not used
    sums.fill(Lanes::Zero());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Eigen::Vector3d d = vertices[i] - origin;
      const Lanes step(d.x(), d.y(), d.z(), 0.0);
      for (std::size_t k = 0; k < kLanes; ++k) sums[k] += static_cast<double>(rows[k][i]) * step;
    }
    for (std::size_t k = 0; k < count; ++k) {
      centers[first + k] = origin + sums[k].head<3>().matrix();
    }
  });
  return centers;
}

}  // namespace capfit::skinning
