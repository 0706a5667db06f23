// Makes the tables of core/refine/layouts/layout_tables.cc: random searches for the topologies that
// serve several bodies at once, mannequins or those of files.
//
//   make_layouts best|enclose cut|full PRIMITIVES CPU_SECONDS [--seed 1] [--from PRIMITIVES]
//                [--women] [--bodies FILE...]
//
// Those for the best fit go on from a stick figure, in one piece, or from what quality tight finds
// for one of the bodies, and never fall into more pieces. Those that enclose go on from the stored
// layout of as many primitives, or --from so many, by default the largest that fits, or from what
// quality tight finds, whichever serves all bodies better; or from a standard layout.
//
// Prints nodes and edges as they stand in the table, to be copied. Two minutes or so each.
#include <cstdio>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
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
  using capfit::refine::Figures;
  capfit::refine::LayoutTask task;
  std::string fit;
  std::string parts;
  CLI::App app{"Searches for a layout that serves several bodies"};
  app.add_option("fit", fit)->required()->check(CLI::IsMember({"best", "enclose"}));
  app.add_option("parts", parts)->required()->check(CLI::IsMember({"cut", "full"}));
  app.add_option("primitives", task.primitives)->required()->check(CLI::PositiveNumber);
  app.add_option("seconds", task.cpu_seconds, "of one processor")->required();
  app.add_option("--seed", task.seed);
  app.add_option("--from", task.first_primitives, "the stored layout for so many to begin with");
  app.add_option("--bodies", task.files, "meshes of whole, symmetric bodies, not mannequins")
      ->check(CLI::ExistingFile);
  app.add_flag_callback(
      "--women", [&] { task.figures = Figures::kWomen; }, "mannequins of women");
  CLI11_PARSE(app, argc, argv);
  task.enclose = fit == "enclose";
  task.full = parts == "full";
  return capfit::refine::Main(task);
}
