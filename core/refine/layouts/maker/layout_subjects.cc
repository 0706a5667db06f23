#include "core/refine/layouts/maker/layout_subjects.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "core/body/find_body.h"
#include "core/formats/read_mesh.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/refine/best_fit/thin_out.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kGridCellM = 0.010;
constexpr double kThinnedM = 0.016;
// Of an enclosing search's points, over the root of the number of primitives, relative to the
// body's size.
constexpr double kEnclosingSpacing = 0.14;
constexpr int kEngineBudget = 64;
constexpr int kEngineLimit = 32;

struct Figure {
  mannequin::MannequinSex sex;
  double arm_angle_rad, height_m, girth;  // girth: 1 is usual
};

std::vector<Figure> FiguresFor(Figures figures) {
  using enum mannequin::MannequinSex;
  if (figures == Figures::kWomen) {
    return {{kFemale, 0.9, 1.66, 1.0}, {kFemale, 1.45, 1.72, 1.05}, {kFemale, 0.7, 1.62, 1.15}};
  }
  return {{kFemale, 0.9, 1.66, 1.0}, {kMale, 1.45, 1.80, 1.0},   {kFemale, 0.7, 1.62, 1.15},
          {kMale, 0.8, 1.76, 1.12},  {kFemale, 1.3, 1.70, 0.94}, {kMale, 0.95, 1.72, 0.95}};
}

int FacesFor(const LayoutTask& task) {
  if (!task.enclose) return 8000;
  return task.primitives > kEngineBudget ? 12'000 : 5000;
}

absl::StatusOr<formats::PolygonSoup> MannequinOf(const Figure& figure, const LayoutTask& task) {
  const bool female = figure.sex == mannequin::MannequinSex::kFemale;
  mannequin::MannequinOptions options;
  options.sex = figure.sex;
  options.arm_angle_rad = figure.arm_angle_rad;
  options.height_m = figure.height_m;
  options.faces = FacesFor(task);
  options.with_head = options.with_hands = options.with_feet = task.full;
  if (figure.girth != 1.0) {
    options.bust_m = 0.54 * figure.height_m * figure.girth;
    options.waist_m = (female ? 0.42 : 0.48) * figure.height_m * figure.girth;
    options.hip_m = 0.57 * figure.height_m * figure.girth;
  }
  return mannequin::MakeMannequin(options);
}

absl::StatusOr<formats::PolygonSoup> Read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return formats::ReadMesh(std::as_bytes(std::span(bytes)));
}

std::optional<Subject> MakeSubject(const absl::StatusOr<formats::PolygonSoup>& soup,
                                   const LayoutTask& task) {
  if (!soup.ok()) return std::nullopt;
  const auto prepared = mesh::PrepareMesh(*soup);
  if (!prepared.ok()) return std::nullopt;
  auto found = body::FindBody(prepared->mesh, {}, ThreadPool(1), NullObserver());
  if (!found.ok() || !found->is_symmetric) return std::nullopt;
  std::vector<Eigen::Vector3f> half;
  for (const Eigen::Vector3d& v : found->mesh.vertices()) {
    if (v.x() >= 0.0) half.push_back(v.cast<float>());
  }
  std::vector<Eigen::Vector3d> thinned;
  for (const Eigen::Vector3f& p : ThinOut(half, kThinnedM)) thinned.push_back(p.cast<double>());
  const Skeleton skeleton(*found);
  Subject subject{*std::move(found), skeleton, {}, {}, {tighten::PointGrid(thinned)},
                  nullptr,           nullptr};
  subject.parts.head = subject.parts.hands = subject.parts.feet = task.full;
  subject.grid = MakeOccupancyGrid(subject.body, subject.parts, kGridCellM, true, ThreadPool(1));
  if (task.enclose) {
    subject.enclosing = std::make_unique<EnclosingTask>(
        tighten::TargetOf(subject.body, subject.parts), /*symmetric=*/true, 0.0,
        kEnclosingSpacing / std::sqrt(task.primitives));
  } else {
    subject.objective = std::make_unique<BestFitObjective>(subject.grid, subject.points, 1);
  }
  return subject;
}

}  // namespace

std::vector<Subject> MakeSubjects(const LayoutTask& task) {
  std::vector<absl::StatusOr<formats::PolygonSoup>> soups;
  for (const std::string& file : task.files) soups.push_back(Read(file));
  if (soups.empty()) {
    for (const Figure& figure : FiguresFor(task.figures)) {
      soups.push_back(MannequinOf(figure, task));
    }
  }
  std::vector<Subject> subjects;
  for (std::size_t i = 0; i < soups.size(); ++i) {
    std::optional<Subject> subject = MakeSubject(soups[i], task);
    if (!subject) {
      std::fprintf(
          stderr, "body %zu: %s\n", i,
          soups[i].ok() ? "not found, or not symmetric" : soups[i].status().ToString().c_str());
      return {};
    }
    subjects.push_back(*std::move(subject));
  }
  return subjects;
}

capsule::Budget BudgetOf(const LayoutTask& task) {
  if (task.enclose && task.primitives == kEngineBudget) {
    return {kEngineBudget, kEngineLimit, kEngineLimit};
  }
  return {task.primitives, capsule::kNoLimit, capsule::kNoLimit};
}

bool ApplyToAll(const Edit& edit, Graphs& graphs) {
  constexpr double kOffPlaneShare = 0.35;
  Graphs result;
  for (const capsule::MirroredSet& graph : graphs) {
    Edit own = edit;
    if (edit.kind == EditKind::kLeaf || edit.kind == EditKind::kBall) {
      const geometry::Sphere& from = graphs[0].sphere(edit.first);
      const geometry::Sphere& to = graph.sphere(edit.first);
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
    result.push_back(std::move(edited.graph));
    if (result.back().spheres().size() != result[0].spheres().size()) return false;
    if (result.back().capsules().size() != result[0].capsules().size()) return false;
  }
  graphs = std::move(result);
  return true;
}

}  // namespace capfit::refine
