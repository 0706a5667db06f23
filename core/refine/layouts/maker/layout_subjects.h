// The bodies that layouts are searched on, and what a search for one is asked.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_MAKER_LAYOUT_SUBJECTS_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_MAKER_LAYOUT_SUBJECTS_H_

#include <cstdint>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "core/body/body.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/best_fit_objective.h"
#include "core/refine/best_fit/growth.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/enclosing/enclosing_task.h"
#include "core/refine/graph/graph_edit.h"
#include "core/refine/layouts/bones.h"

namespace capfit::refine {

// Whom a layout is for.
enum class Figures { kAll, kWomen };

struct LayoutTask {
  bool enclose = false;
  bool full = false;  // with head, hands and feet
  Figures figures = Figures::kAll;
  std::vector<std::string> files;  // meshes, in place of the mannequins
  int primitives = 0;
  int first_primitives = 0;  // enclosing: the search starts from the stored layout of this budget
  double cpu_seconds = 0.0;
  std::uint64_t seed = 1;
};

// One body with all that judging a set on it needs.
struct Subject {
  body::Body body;
  Skeleton skeleton;
  body::PartSelection parts;
  OccupancyGrid grid;
  SurfacePoints points;
  std::unique_ptr<BestFitObjective> objective;  // of the best fit
  std::unique_ptr<EnclosingTask> enclosing;
};

// The bodies of the files asked for, or else some of the figures, slim, usual and heavy. Empty
// where one could not be made, or is not symmetric.
[[nodiscard]] std::vector<Subject> MakeSubjects(const LayoutTask& task);

// The same topology on all bodies: graphs whose nodes and edges correspond by index.
using Graphs = std::vector<capsule::MirroredSet>;

// What a search may spend; 32 + 32 where 64 are asked for: the limits of common engines.
[[nodiscard]] capsule::Budget BudgetOf(const LayoutTask& task);

// The edit on all graphs; places are carried over relative to the sphere `first`. False, and no
// change, where the graphs would no longer correspond.
[[nodiscard]] bool ApplyToAll(const Edit& edit, Graphs& graphs);

[[nodiscard]] inline double CpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_MAKER_LAYOUT_SUBJECTS_H_
