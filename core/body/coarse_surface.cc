#include "core/body/coarse_surface.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/base/disjoint_sets.h"
#include "core/mesh/surface_sums.h"

namespace capfit::body {
namespace {

// Nodes to aim at: with 6000 the crotch of a body comes out some 3 mm off.
constexpr std::size_t kNodes = 10'000;
// Copies of fewer vertices are taken as they are.
constexpr std::size_t kManyVertices = 16'000;
// No vertex of a node is farther from its first: 1.5 times the radius of a disc of a node's area.
constexpr double kReach = 0.0085;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;
constexpr std::size_t kTakenAtOnce = 1024;  // triangles

// The vertices of one chunk, gathered around the first that no node has yet, over edges that lead
// on along the curve by which they are sorted: those are at hand with the triangles of each vertex.
class NodeGatherer {
 public:
  NodeGatherer(const WorkingCopy& copy, std::size_t begin, std::size_t end,
               std::vector<std::uint32_t>& node)
      : copy_(copy),
        triangles_(copy.mesh.triangles()),
        first_triangle_(copy.mesh.first_triangle()),
        begin_(static_cast<std::uint32_t>(begin)),
        end_(static_cast<std::uint32_t>(end)),
        most_((copy.points.size() + kNodes - 1) / kNodes),
        node_(node) {}

  // Numbers the nodes of the chunk from 0; returns how many there are.
  std::uint32_t Run() {
    std::fill(node_.begin() + begin_, node_.begin() + end_, kNone);
    for (std::uint32_t v = begin_; v < end_; ++v) {
      if (node_[v] == kNone) GatherFrom(v);
    }
    return count_;
  }

 private:
  // The vertices of the chunk that follow `v` in a triangle that begins there: nearly all that
  // come after it and share an edge with it.
  template <typename Visit>
  void VisitNext(std::uint32_t v, const Visit& visit) const {
    for (std::uint32_t t = first_triangle_[v]; t < first_triangle_[v + 1]; ++t) {
      const std::uint32_t n = triangles_[t][1];
      if (n < end_) visit(n);
    }
  }

  // Where vertices are sparse, as on the arms of a figure with a fine face, they stay apart.
  [[nodiscard]] bool IsNear(std::uint32_t a, std::uint32_t b) const {
    return (copy_.points[a] - copy_.points[b]).squaredNorm() <= kReach * kReach;
  }

  void GatherFrom(std::uint32_t v) {
    gathered_.assign(1, v);
    node_[v] = count_;
    std::uint32_t neighbour = kNone;
    bool has_one_neighbour = true;
    for (std::size_t i = 0; i < gathered_.size() && gathered_.size() < most_; ++i) {
      VisitNext(gathered_[i], [&](std::uint32_t n) {
        if (node_[n] == count_) return;
        if (node_[n] != kNone) {
          has_one_neighbour &= neighbour == kNone || neighbour == node_[n];
          neighbour = node_[n];
        } else if (gathered_.size() < most_ && IsNear(v, n)) {
          node_[n] = count_;
          gathered_.push_back(n);
        }
      });
    }
    const bool is_left_over =
        2 * gathered_.size() < most_ || (has_one_neighbour && gathered_.size() < most_);
    if (!is_left_over || neighbour == kNone) {
      ++count_;
      return;
    }
    // What lies between others joins one of them.
    for (const std::uint32_t n : gathered_) node_[n] = neighbour;
  }

  const WorkingCopy& copy_;
  std::span<const mesh::Triangle> triangles_;
  std::span<const std::uint32_t> first_triangle_;
  std::uint32_t begin_;
  std::uint32_t end_;
  std::size_t most_;
  std::vector<std::uint32_t>& node_;
  std::vector<std::uint32_t> gathered_;
  std::uint32_t count_ = 0;
};

class Coarsener {
 public:
  Coarsener(const WorkingCopy& copy, const ThreadPool& pool)
      : copy_(copy),
        triangles_(copy.mesh.triangles()),
        mates_(copy.mesh.mates()),
        first_triangle_(copy.mesh.first_triangle()),
        pool_(pool) {}

  // Nothing where the nodes come apart.
  std::optional<CoarseSurface> Run() {
    NumberNodes();
    ChooseTriangles();
    AbsorbLoneNodes();
    coarse_.points.assign(node_count_, Eigen::Vector3d::Zero());
    coarse_.triangles.resize(chosen_.size());
    coarse_.mates.assign(3 * chosen_.size(), mesh::kNoMate);
    bool hangs_together = false;
    const std::size_t chunks = (chosen_.size() + kTakenAtOnce - 1) / kTakenAtOnce;
    pool_.ForEach(2 + chunks, [&](std::size_t task) {  // the longest first
      if (task == 0) return void(hangs_together = HangsTogether());
      if (task == 1) return GatherVertices();
      const std::size_t begin = (task - 2) * kTakenAtOnce;
      TakeTriangles(begin, std::min(begin + kTakenAtOnce, chosen_.size()));
    });
    if (!hangs_together) return std::nullopt;
    return std::move(coarse_);
  }

 private:
  void NumberNodes() {
    node_.resize(copy_.points.size());
    std::vector<std::uint32_t> first((node_.size() + kMeshChunk - 1) / kMeshChunk + 1, 0);
    pool_.ForChunks(node_.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      first[begin / kMeshChunk + 1] = NodeGatherer(copy_, begin, end, node_).Run();
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    pool_.ForChunks(node_.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) node_[v] += first[begin / kMeshChunk];
    });
    node_count_ = first.back();
  }

  [[nodiscard]] mesh::Triangle NodesOf(std::size_t triangle) const {
    const mesh::Triangle& t = triangles_[triangle];
    return {node_[t[0]], node_[t[1]], node_[t[2]]};
  }

  void ChooseTriangles() {
    const std::size_t count = triangles_.size();
    place_.resize(count);
    has_triangle_.assign(node_count_, 0);
    std::vector<std::vector<std::uint32_t>> chosen((count + kMeshChunk - 1) / kMeshChunk);
    pool_.ForChunks(count, kMeshChunk, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& own = chosen[begin / kMeshChunk];
      own.resize(end - begin + 1);
      std::size_t kept = 0;
      for (std::size_t i = begin; i < end; ++i) {
        const mesh::Triangle t = NodesOf(i);
        const std::size_t is_kept =
            std::size_t{t[0] != t[1]} & std::size_t{t[1] != t[2]} & std::size_t{t[2] != t[0]};
        place_[i] = is_kept != 0 ? 0 : kNone;
        own[kept] = static_cast<std::uint32_t>(i);
        kept += is_kept;
      }
      own.resize(kept);
    });
    std::vector<std::size_t> first(chosen.size() + 1, 0);
    for (std::size_t c = 0; c < chosen.size(); ++c) first[c + 1] = first[c] + chosen[c].size();
    chosen_.resize(first.back());
    pool_.ForChunks(chosen.size(), 1, [&](std::size_t c, std::size_t) {
      auto next = static_cast<std::uint32_t>(first[c]);
      for (const std::uint32_t i : chosen[c]) {
        // Several threads may say so of one node.
        for (const std::uint32_t n : NodesOf(i)) {
          std::atomic_ref(has_triangle_[n]).store(1, std::memory_order_relaxed);
        }
        chosen_[next] = i;
        place_[i] = next++;
      }
    });
  }

  // Nodes that others leave no triangle of their own join a neighbour.
  void AbsorbLoneNodes() {
    const auto is_lone = [&](std::uint32_t n) { return has_triangle_[n] == 0; };
    if (std::find(has_triangle_.begin(), has_triangle_.end(), 0) == has_triangle_.end()) return;
    std::vector<std::uint32_t> joins(node_count_);
    for (std::uint32_t n = 0; n < node_count_; ++n) joins[n] = is_lone(n) ? kNone : n;
    const auto is_of_lone = [&](std::size_t v) { return is_lone(node_[v]); };
    for (const std::uint32_t v : Which(node_.size(), is_of_lone)) {
      if (joins[node_[v]] != kNone) continue;
      for (std::uint32_t i = first_triangle_[v]; i < first_triangle_[v + 1]; ++i) {
        for (const std::uint32_t n : NodesOf(i)) {
          if (joins[n] != kNone) joins[node_[v]] = joins[n];
        }
      }
    }
    if (std::find(joins.begin(), joins.end(), kNone) != joins.end()) AskAllTriangles(joins);
    std::vector<std::uint32_t> number(node_count_, 0);
    node_count_ = 0;
    for (std::uint32_t n = 0; n < joins.size(); ++n) {
      if (joins[n] == n || joins[n] == kNone) number[n] = node_count_++;
    }
    pool_.ForChunks(node_.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const std::uint32_t n = node_[v];
        node_[v] = number[joins[n] == kNone ? n : joins[n]];
      }
    });
  }

  // Of nodes whose neighbours all come before them.
  void AskAllTriangles(std::vector<std::uint32_t>& joins) const {
    const auto touches_lone = [&](std::size_t i) {
      const mesh::Triangle t = NodesOf(i);
      return joins[t[0]] == kNone || joins[t[1]] == kNone || joins[t[2]] == kNone;
    };
    for (const std::uint32_t i : Which(triangles_.size(), touches_lone)) {
      const mesh::Triangle t = NodesOf(i);
      for (const std::uint32_t n : t) {
        if (joins[n] != kNone) continue;
        for (const std::uint32_t other : t) {
          if (joins[other] != kNone) joins[n] = joins[other];
        }
      }
    }
  }

  // The numbers below `count` for which is_wanted(number), in order.
  template <typename IsWanted>
  [[nodiscard]] std::vector<std::uint32_t> Which(std::size_t count,
                                                 const IsWanted& is_wanted) const {
    std::vector<std::vector<std::uint32_t>> found((count + kMeshChunk - 1) / kMeshChunk);
    pool_.ForChunks(count, kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (is_wanted(i)) found[begin / kMeshChunk].push_back(static_cast<std::uint32_t>(i));
      }
    });
    std::vector<std::uint32_t> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  // Whether every node can be reached from every other over the triangles that are kept.
  [[nodiscard]] bool HangsTogether() const {
    DisjointSets sets(node_count_);
    std::size_t pieces = sets.size();
    for (const std::uint32_t i : chosen_) {
      const mesh::Triangle t = NodesOf(i);
      for (const std::uint32_t n : {t[1], t[2]}) pieces -= sets.Join(t[0], n) ? 1 : 0;
    }
    return pieces == 1;
  }

  void GatherVertices() {
    coarse_.first.assign(node_count_ + 2, 0);
    for (const std::uint32_t n : node_) ++coarse_.first[n + 2];
    std::partial_sum(coarse_.first.begin(), coarse_.first.end(), coarse_.first.begin());
    coarse_.vertices.resize(node_.size());
    // first[n + 1] serves as the write position of n and ends as the start of n + 1.
    for (std::uint32_t v = 0; v < node_.size(); ++v) {
      coarse_.vertices[coarse_.first[node_[v] + 1]++] = v;
      coarse_.points[node_[v]] += copy_.points[v];
    }
    coarse_.first.pop_back();
    for (std::uint32_t n = 0; n < node_count_; ++n) {
      coarse_.points[n] /= static_cast<double>(coarse_.VerticesOf(n).size());
    }
  }

  // Where the way over half-edge `h` of a kept triangle, which ends at the node `end`, arrives:
  // through triangles that shrank to the edge. All half-edges that it comes in over begin at `end`.
  [[nodiscard]] mesh::HalfEdge Across(mesh::HalfEdge h, std::uint32_t end) const {
    for (mesh::HalfEdge at = mates_[h];;) {
      if (place_[at / 3] != kNone) return 3 * place_[at / 3] + at % 3;
      const mesh::HalfEdge before = mesh::PreviousInTriangle(at);
      const std::uint32_t third = node_[mesh::StartOf(triangles_, before)];
      at = mates_[third == end ? mesh::NextInTriangle(at) : before];
    }
  }

  // Of the kept triangles those in [begin, end). Mates in another chunk are found from both sides.
  void TakeTriangles(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      coarse_.triangles[i] = NodesOf(chosen_[i]);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto here = static_cast<mesh::HalfEdge>(3 * i + k);
        if (coarse_.mates[here] != mesh::kNoMate) continue;
        const mesh::HalfEdge mate =
            Across(3 * chosen_[i] + k, mesh::EndOf(coarse_.triangles, here));
        coarse_.mates[here] = mate;
        if (mate >= 3 * begin && mate < 3 * end) coarse_.mates[mate] = here;
      }
    }
  }

  const WorkingCopy& copy_;
  std::span<const mesh::Triangle> triangles_;
  std::span<const mesh::HalfEdge> mates_;
  std::span<const std::uint32_t> first_triangle_;
  const ThreadPool& pool_;
  CoarseSurface coarse_;
  std::uint32_t node_count_ = 0;
  std::vector<std::uint32_t> node_;    // of each vertex
  std::vector<std::uint32_t> chosen_;  // triangles that are kept
  std::vector<char> has_triangle_;     // by node: one of those
  std::vector<std::uint32_t> place_;   // of each triangle among those
};

CoarseSurface AsItIs(const WorkingCopy& copy) {
  CoarseSurface same;
  same.points.assign(copy.points.begin(), copy.points.end());
  same.triangles.assign(copy.mesh.triangles().begin(), copy.mesh.triangles().end());
  same.mates.assign(copy.mesh.mates().begin(), copy.mesh.mates().end());
  same.vertices.resize(copy.points.size());
  std::iota(same.vertices.begin(), same.vertices.end(), 0u);
  same.first.resize(copy.points.size() + 1);
  std::iota(same.first.begin(), same.first.end(), 0u);
  return same;
}

std::vector<double> NodeAreas(const CoarseSurface& coarse, const ThreadPool& pool) {
  std::vector<double> thirds(coarse.triangles.size());
  pool.ForChunks(thirds.size(), kTakenAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      thirds[i] = mesh::Area(coarse.points, coarse.triangles[i]) / 3.0;
    }
  });
  std::vector<double> areas(coarse.points.size(), 0.0);
  double area = 0.0;
  for (std::size_t i = 0; i < thirds.size(); ++i) {
    area += 3.0 * thirds[i];
    for (const std::uint32_t n : coarse.triangles[i]) areas[n] += thirds[i];
  }
  for (double& a : areas) a /= area;
  return areas;
}

}  // namespace

CoarseSurface MakeCoarseSurface(const WorkingCopy& copy, const ThreadPool& pool) {
  std::optional<CoarseSurface> coarse;
  if (copy.points.size() >= kManyVertices) coarse = Coarsener(copy, pool).Run();
  // Parts as thin as a node come off.
  if (!coarse) coarse = AsItIs(copy);
  coarse->areas = NodeAreas(*coarse, pool);
  return *std::move(coarse);
}

}  // namespace capfit::body
