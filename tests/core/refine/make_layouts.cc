// Makes the tables of core/refine/layout_tables.cc: a random search for the topology that serves
// three mannequins at once.
//
//   make_layouts best|enclose cut|full PRIMITIVES CPU_SECONDS [SEED]
//
// Those for the best fit hang together: no sphere without a capsule, all in one piece.
//
// Prints nodes and edges as they stand in the table, to be copied. A minute or two each.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/refine/best_fit_descent.h"
#include "core/refine/best_fit_objective.h"
#include "core/refine/enclosing_task.h"
#include "core/refine/growth.h"
#include "core/refine/internal.h"
#include "core/refine/layout.h"

namespace capfit::refine {
namespace {

// What a mean distance of one percent of the body's diagonal, left uncovered, weighs beside E_r:
// otherwise hands are the first to go.
constexpr double kDistanceWeight = 0.1;
constexpr double kDiagonalsPerHeight = 1.25;
constexpr double kGridCellM = 0.010;
constexpr double kThinnedM = 0.016;
constexpr double kEnclosingSpacing = 0.02;  // of points, relative to the body's size

struct Task {
  bool enclose = false;
  bool full = false;
  int primitives = 0;
  double cpu_seconds = 0.0;
  std::uint64_t seed = 1;
};

// One mannequin with all that judging a set on it needs.
struct Subject {
  body::Body body;
  OccupancyGrid grid;
  CoverPoints points;
  std::unique_ptr<Objective> objective;  // of the best fit
  std::unique_ptr<EnclosingTask> enclosing;
};

struct Figure {
  mannequin::MannequinSex sex;
  double arm_angle_rad, height_m, girth;  // girth: 1 is usual
};

std::optional<Subject> MakeSubject(const Figure& figure, const Task& task) {
  const bool female = figure.sex == mannequin::MannequinSex::kFemale;
  mannequin::MannequinOptions options;
  options.sex = figure.sex;
  options.arm_angle_rad = figure.arm_angle_rad;
  options.height_m = figure.height_m;
  options.faces = task.enclose ? 5000 : 8000;
  options.with_head = options.with_hands = options.with_feet = task.full;
  if (figure.girth != 1.0) {
    options.bust_m = 0.54 * figure.height_m * figure.girth;
    options.waist_m = (female ? 0.42 : 0.48) * figure.height_m * figure.girth;
    options.hip_m = 0.57 * figure.height_m * figure.girth;
  }
  const auto soup = mannequin::MakeMannequin(options);
  if (!soup.ok()) return std::nullopt;
  const auto prepared = mesh::PrepareMesh(*soup);
  if (!prepared.ok()) return std::nullopt;
  body::BodyOptions body_options;
  body_options.unit = body::Unit::kMetre;
  auto found = body::FindBody(prepared->mesh, body_options, ThreadPool(1), NullObserver());
  if (!found.ok() || !found->is_symmetric) return std::nullopt;
  Subject subject{*std::move(found), {}, {}, nullptr, nullptr};
  body::PartSelection parts;
  parts.head = parts.hands = parts.feet = task.full;
  subject.grid = MakeOccupancyGrid(subject.body, parts, kGridCellM, true);
  std::vector<CoverPoint> points;
  for (const Eigen::Vector3d& v : subject.body.mesh.vertices()) {
    if (v.x() >= 0.0) points.push_back({v.cast<float>(), 0.0f});
  }
  subject.points = MakeCoverPoints(ThinOut(points, kThinnedM));
  if (task.enclose) {
    subject.enclosing = std::make_unique<EnclosingTask>(coverage::TargetOf(subject.body, parts),
                                                        /*symmetric=*/true, 0.0, kEnclosingSpacing);
  } else {
    subject.objective = std::make_unique<BestFitObjective>(subject.grid, subject.points, 1);
  }
  return subject;
}

// From joint to joint: where the search begins.
CapsuleGraph HangStick(const Subject& subject, const Task& task) {
  std::vector<LayoutNode> nodes = {
      {BoneId::kBelly, {0.5, 0, 0.3}, 1.2, false}, {BoneId::kChest, {0.0, 0, 0}, 1.2, false},
      {BoneId::kChest, {0.9, 0, 0}, 0.9, false},   {BoneId::kClavicle, {0.8, 0, 0}, 1.0, true},
      {BoneId::kForearm, {0.0, 0, 0}, 1.0, true},  {BoneId::kForearm, {0.95, 0, 0}, 0.8, true},
      {BoneId::kPelvis, {0.8, 0, 0}, 1.2, true},   {BoneId::kShin, {0.0, 0, 0}, 0.9, true},
      {BoneId::kShin, {0.95, 0, 0}, 0.7, true},    {BoneId::kHead, {0.6, 0, 0.2}, 1.6, false},
      {BoneId::kHand, {0.6, 0, 0}, 1.0, true},     {BoneId::kFoot, {0.6, 0, 0}, 1.0, true}};
  std::vector<LayoutEdge> edges = {{0, 1, false}, {1, 2, false},  {2, 3, false}, {3, 4, false},
                                   {4, 5, false}, {0, 6, false},  {6, 7, false}, {7, 8, false},
                                   {2, 9, false}, {5, 10, false}, {8, 11, false}};
  if (!task.full) nodes.resize(9), edges.resize(8);
  body::PartSelection parts;
  parts.head = parts.hands = parts.feet = task.full;
  return HangLayout({nodes, edges}, subject.body, parts, true);
}

Edit MakeEdit(EditKind kind, int first, int second) {
  Edit edit;
  edit.kind = kind;
  edit.first = first;
  edit.second = second;
  return edit;
}

// The same topology on all mannequins: graphs whose nodes and edges correspond by index.
using Graphs = std::vector<CapsuleGraph>;

class Search {
 public:
  Search(const Task& task, const std::vector<Subject>& subjects)
      : task_(task), subjects_(subjects), random_(task.seed) {
    spending_ = {task.primitives, 1'000'000, 1'000'000};
    // The limits of common engines.
    if (task.enclose && task.primitives == 64) spending_ = {64, 32, 32};
  }

  Graphs Run() {
    Graphs now;
    for (const Subject& s : subjects_) now.push_back(HangStick(s, task_));
    Settle(100, 0.006, now);
    for (CapsuleGraph& graph : now) RemoveSwallowed(graph);
    while (!spending_.Allows(now[0]) && SpareOne(now)) {
    }
    double value = ValueOf(now);
    while (Elapsed() < task_.cpu_seconds) {
      Graphs next = Changed(now);
      Settle(40, 0.004, next);
      double next_value = ValueOf(next);
      if (next_value < 1.03 * value) {
        Settle(64, 0.002, next);
        next_value = ValueOf(next);
      }
      const bool grown = next[0].primitive_count() > now[0].primitive_count();
      // Slightly worse is taken at first, lest the search end in the nearest minimum.
      const double cooling = std::max(0.0, 1.0 - 1.3 * Elapsed() / task_.cpu_seconds);
      const double slack = grown ? 0.0 : 0.004 * value * cooling * random_.NextUnit();
      if (next_value >= value + slack) continue;
      now = std::move(next);
      value = next_value;
      if (value < best_value_ && spending_.Allows(now[0])) best_ = now, best_value_ = value;
    }
    if (best_.empty()) best_ = now;
    Settle(200, 0.002, best_);
    return best_;
  }

 private:
  static double Elapsed() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

  int Below(int count) {
    return static_cast<int>(random_.NextBelow(static_cast<std::uint64_t>(count)));
  }

  [[nodiscard]] double ValueOf(const Graphs& graphs) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      const Subject& s = subjects_[k];
      if (task_.enclose) {
        sum += s.enclosing->Value(graphs[k], alone_) / s.grid.volume_m3 - 1.0;
        continue;
      }
      sum += s.objective->Value(graphs[k]);
      const double mean_m =
          FindDeepest(s.points, ConesOf(graphs[k])).SumOutside() / s.points.size();
      // About half of the surface lies outside of a best fit.
      sum += kDistanceWeight * 100.0 * 2.0 * mean_m / (kDiagonalsPerHeight * s.body.height_m);
    }
    return sum / static_cast<double>(graphs.size());
  }

  void Settle(int steps, double rate_m, Graphs& graphs) {
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      const Subject& s = subjects_[k];
      if (task_.enclose) {
        const std::uint64_t seed = random_.NextBelow(1'000'000);
        s.enclosing->FindShape(2 + steps / 10, 1.0, seed, alone_, observer_, graphs[k]);
        s.enclosing->TakeIn(2 + steps / 50, seed, alone_, observer_, graphs[k]);
      } else {
        BestFitOptions options;
        options.steps = steps;
        options.first_rate_m = rate_m;
        options.seed = random_.NextBelow(1'000'000);
        DescendBestFit(s.grid, options, graphs[k]);
      }
    }
  }

  // The edit on all graphs; places are carried over relative to the sphere `first`. False, and no
  // change, where the graphs would no longer correspond.
  bool ApplyToAll(const Edit& edit, Graphs& graphs) const {
    const bool linked = !task_.enclose;
    constexpr double kOffPlaneShare = 0.35;
    Graphs result;
    for (const CapsuleGraph& graph : graphs) {
      Edit own = edit;
      if (edit.kind == EditKind::kLeaf || edit.kind == EditKind::kBall) {
        const Node& from = graphs[0].nodes[U(edit.first)];
        const Node& to = graph.nodes[U(edit.first)];
        const double scale = to.radius_m / from.radius_m;
        own.center_m = to.center_m + scale * (edit.center_m - from.center_m);
        own.radius_m = scale * edit.radius_m;
        const double aside = kOffPlaneShare * own.radius_m;
        if (std::abs(edit.center_m.x()) < kOffPlaneShare * edit.radius_m) {
          own.center_m.x() = 0.0;
        } else if (std::abs(own.center_m.x()) < aside) {
          own.center_m.x() = std::copysign(aside, edit.center_m.x());
        }
      }
      EditedGraph edited = Apply(graph, own);
      if (!edited.possible) return false;
      if (linked && ComponentCount(edited.graph) > 1) return false;
      result.push_back(std::move(edited.graph));
      if (result.back().nodes.size() != result[0].nodes.size()) return false;
      if (result.back().edges.size() != result[0].edges.size()) return false;
    }
    graphs = std::move(result);
    return true;
  }

  bool SpareOne(Graphs& graphs) {
    Graphs best;
    double least = std::numeric_limits<double>::max();
    const int edges = graphs[0].capsule_count();
    for (int i = 0; i < edges + graphs[0].sphere_count(); ++i) {
      Graphs next = graphs;
      const bool is_edge = i < edges;
      if (is_edge ? !graphs[0].IsEdgeRepresentative(i)
                  : !graphs[0].IsNodeRepresentative(i - edges)) {
        continue;
      }
      if (!ApplyToAll(MakeEdit(is_edge ? EditKind::kUnlink : EditKind::kDissolve,
                               is_edge ? i : i - edges, -1),
                      next)) {
        continue;
      }
      Settle(24, 0.004, next);
      const double value = ValueOf(next);
      if (value < least) least = value, best = std::move(next);
    }
    if (best.empty()) return false;
    graphs = std::move(best);
    return true;
  }

  // Up to three removals where the budget is used up, then additions until it is again.
  Graphs Changed(const Graphs& graphs) {
    constexpr int kMostTries = 24;
    Graphs next = graphs;
    const bool used_up = graphs[0].primitive_count() >= task_.primitives - 1;
    for (int left = used_up ? 1 + Below(3) : 0; left > 0;) {
      const CapsuleGraph& graph = next[0];
      const bool edge = graph.capsule_count() > 0 && random_.NextUnit() < 0.5;
      const int i = Below(edge ? graph.capsule_count() : graph.sphere_count());
      if (edge ? !graph.IsEdgeRepresentative(i) : !graph.IsNodeRepresentative(i)) continue;
      ApplyToAll(MakeEdit(edge ? EditKind::kUnlink : EditKind::kDissolve, i, -1), next);
      --left;
    }
    // Enclosing sets grow by cuts and ties alone.
    const std::vector<Eigen::Vector3d> worst =
        task_.enclose ? std::vector<Eigen::Vector3d>()
                      : subjects_[0].objective->WorstPoints(next[0], 24);
    int added = 0;
    for (int i = 0; i < kMostTries; ++i) {
      const int room = task_.primitives - next[0].primitive_count();
      if (used_up ? room <= (i > kMostTries / 2 ? 1 : 0) : added >= 2) break;
      const std::optional<Edit> edit = RandomAddition(next[0], worst);
      if (!edit) continue;
      Graphs tried = next;
      if (!ApplyToAll(*edit, tried) || !spending_.Allows(tried[0])) continue;
      next = std::move(tried);
      ++added;
    }
    return next;
  }

  std::optional<Edit> RandomAddition(const CapsuleGraph& graph,
                                     const std::vector<Eigen::Vector3d>& worst) {
    const double lot = random_.NextUnit();
    if (lot < 0.35) {
      if (graph.capsule_count() == 0) return std::nullopt;
      return MakeEdit(EditKind::kSplit, Below(graph.capsule_count()), -1);
    }
    if (lot < 0.7) {
      const int i = Below(graph.sphere_count()), j = Below(graph.sphere_count());
      const Node& a = graph.nodes[U(i)];
      const Node& b = graph.nodes[U(j)];
      const double apart_m = (a.center_m - b.center_m).norm();
      if (i == j || apart_m > 1.3 * (a.radius_m + b.radius_m)) return std::nullopt;
      return MakeEdit(EditKind::kLink, i, j);
    }
    if (lot < 0.93) {
      if (worst.empty()) return std::nullopt;
      const auto at = static_cast<std::size_t>(Below(static_cast<int>(worst.size())));
      std::vector<Edit> leaves = LeavesAt(graph, worst[at]);
      if (leaves.empty()) return std::nullopt;
      Edit leaf = leaves[random_.NextBelow(leaves.size())];
      if (task_.enclose && random_.NextUnit() < 0.15) leaf.kind = EditKind::kBall;
      return leaf;
    }
    const int v = Below(graph.sphere_count());
    if (!graph.IsOnPlane(v)) return std::nullopt;
    return MakeEdit(EditKind::kPart, v, Below(2));
  }

  const Task& task_;
  const std::vector<Subject>& subjects_;
  Spending spending_{};
  Random random_;
  const ThreadPool alone_{1};
  const NullObserver observer_;
  Graphs best_;
  double best_value_ = std::numeric_limits<double>::max();
};

// The bone that the node is nearest to on all mannequins, in the bone's radii.
BoneId NearestBone(const std::vector<Skeleton>& skeletons, const Graphs& graphs, int v) {
  BoneId nearest = BoneId::kBelly;
  double least = std::numeric_limits<double>::max();
  for (int b = 0; b < (graphs[0].IsOnPlane(v) ? kMidBoneCount : kBoneCount); ++b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      const std::optional<Bone>& bone = skeletons[k].bone(static_cast<BoneId>(b), Side::kLeft);
      if (!bone) sum = std::numeric_limits<double>::infinity();
      if (!bone) break;
      const Eigen::Vector3d along = bone->to_m - bone->from_m;
      const Eigen::Vector3d p = graphs[k].nodes[U(v)].center_m - bone->from_m;
      const double t = std::clamp(p.dot(along) / along.squaredNorm(), 0.0, 1.0);
      sum += (p - t * along).norm() / bone->radius_m;
    }
    if (sum < least) least = sum, nearest = static_cast<BoneId>(b);
  }
  return nearest;
}

void Print(const std::vector<Subject>& subjects, const Graphs& graphs) {
  static constexpr const char* kNames[kBoneCount] = {
      "kBelly", "kRibs",   "kChest", "kHead", "kClavicle", "kUpperArm", "kForearm",
      "kHand",  "kPelvis", "kThigh", "kShin", "kFoot",     "kHeel"};
  std::vector<Skeleton> skeletons;
  for (const Subject& s : subjects) skeletons.emplace_back(s.body);
  const CapsuleGraph& first = graphs[0];
  std::vector<int> row(first.nodes.size(), -1);
  std::vector<char> is_right(first.nodes.size(), 0);
  int rows = 0;
  for (int v = 0; v < first.sphere_count(); ++v) {
    const bool on_plane = first.IsOnPlane(v);
    if (!on_plane && first.nodes[U(v)].center_m.x() < 0.0) continue;
    const BoneId bone = NearestBone(skeletons, graphs, v);
    Eigen::Vector4d mean = Eigen::Vector4d::Zero();
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      const Node& node = graphs[k].nodes[U(v)];
      const BonePlace place = *skeletons[k].PlaceOf(bone, Side::kLeft, node.center_m);
      const double radius = node.radius_m / skeletons[k].bone(bone, Side::kLeft)->radius_m;
      mean += Eigen::Vector4d(place.along, on_plane ? 0.0 : place.aside, place.ahead, radius) /
              static_cast<double>(graphs.size());
    }
    row[U(v)] = rows;
    if (!on_plane) row[U(first.nodes[U(v)].mirror)] = rows;
    if (!on_plane) is_right[U(first.nodes[U(v)].mirror)] = 1;
    std::printf("    {BoneId::%s, {%.2f, %.1f, %.1f}, %.1f, %s},  // %d\n",
                kNames[static_cast<int>(bone)], mean[0], mean[1], mean[2], std::max(0.1, mean[3]),
                on_plane ? "false" : "true", rows++);
  }
  for (int e = 0; e < first.capsule_count(); ++e) {
    if (!first.IsEdgeRepresentative(e)) continue;
    const Edge& edge = first.edges[U(e)];
    const bool crossed = !first.IsOnPlane(edge.a) && !first.IsOnPlane(edge.b) &&
                         is_right[U(edge.a)] != is_right[U(edge.b)];
    std::printf("    {%d, %d, %s},\n", std::min(row[U(edge.a)], row[U(edge.b)]),
                std::max(row[U(edge.a)], row[U(edge.b)]), crossed ? "true" : "false");
  }
}

int Main(const Task& task) {
  std::vector<Subject> subjects;
  for (const Figure& figure : {Figure{mannequin::MannequinSex::kFemale, 0.9, 1.66, 1.0},
                               Figure{mannequin::MannequinSex::kMale, 1.45, 1.80, 1.0},
                               Figure{mannequin::MannequinSex::kFemale, 0.7, 1.62, 1.15}}) {
    std::optional<Subject> subject = MakeSubject(figure, task);
    if (!subject) return 1;
    subjects.push_back(*std::move(subject));
  }
  Print(subjects, Search(task, subjects).Run());
  return 0;
}

}  // namespace
}  // namespace capfit::refine

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr,
                 "usage: make_layouts best|enclose cut|full PRIMITIVES CPU_SECONDS [SEED]\n");
    return 2;
  }
  capfit::refine::Task task;
  task.enclose = std::string(argv[1]) == "enclose";
  task.full = std::string(argv[2]) == "full";
  task.primitives = std::atoi(argv[3]);
  task.cpu_seconds = std::atof(argv[4]);
  if (argc > 5) task.seed = static_cast<std::uint64_t>(std::atoi(argv[5]));
  return capfit::refine::Main(task);
}
