// Makes the tables of core/refine/layouts/layout_tables.cc: random searches for the topologies that
// serve several mannequins at once.
//
//   make_layouts best|enclose[-women] cut|full PRIMITIVES CPU_SECONDS [SEED [FROM_PRIMITIVES]]
//
// Those for the best fit go on from a stick figure, in one piece, or from what quality tight finds
// for one of the mannequins, and never fall into more pieces. Those that enclose go on from the
// stored layout for FROM_PRIMITIVES, by default the largest that fits, or from what quality tight
// finds, whichever serves all mannequins better; or from a standard layout.
//
// Prints nodes and edges as they stand in the table, to be copied. Two minutes or so each.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/refine/layouts/maker/best_fit_layout_search.h"
#include "core/refine/layouts/maker/enclosing_layout_search.h"
#include "core/refine/layouts/maker/hung_layout.h"
#include "core/refine/layouts/maker/layout_subjects.h"

namespace capfit::refine {
namespace {

int Main(const LayoutTask& task) {
  const std::vector<Subject> subjects = MakeSubjects(task);
  if (subjects.empty()) return 1;
  Print(LayoutOf(subjects, task.enclose ? SearchEnclosingLayout(task, subjects)
                                        : SearchBestFitLayout(task, subjects)));
  return 0;
}

}  // namespace
}  // namespace capfit::refine

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr,
                 "usage: make_layouts best|enclose[-women] cut|full PRIMITIVES CPU_SECONDS "
                 "[SEED [FROM_PRIMITIVES]]\n");
    return 2;
  }
  capfit::refine::LayoutTask task;
  const std::string figures = argv[1];
  task.enclose = figures.rfind("enclose", 0) == 0;
  if (figures == "enclose-women") task.figures = capfit::refine::Figures::kWomen;
  task.full = std::string(argv[2]) == "full";
  task.primitives = std::atoi(argv[3]);
  task.cpu_seconds = std::atof(argv[4]);
  if (argc > 5) task.seed = static_cast<std::uint64_t>(std::atoi(argv[5]));
  if (argc > 6) task.first_primitives = std::atoi(argv[6]);
  return capfit::refine::Main(task);
}
