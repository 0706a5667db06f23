#include "core/tighten/penalty_program.h"

#include <utility>

#include "core/base/short_loops.h"
#include "core/tighten/interior_point.h"
#include "core/tighten/normal_blocks.h"
#include "core/tighten/row_table.h"

namespace capfit::tighten {
namespace {

// Programmes that may be left so far from solved are reckoned in floats, twice as many at a time.
constexpr double kFloatGap = 0.01;

}  // namespace

struct PenaltySolver::Memory {
  NormalBlocks normal;
  RowTable<float> floats;
  RowTable<double> doubles;
};

PenaltySolver::PenaltySolver(const ThreadPool& pool)
    : pool_(pool), memory_(std::make_unique<Memory>()) {}

PenaltySolver::~PenaltySolver() = default;

Eigen::VectorXd PenaltySolver::Solve(const PenaltyProgram& program, const SolveTo& to) {
  const bool is_to_centre = to.centrality > 0.0;
  const bool is_in_floats = is_to_centre || to.relative_gap >= kFloatGap;
  const RowLayout layout = LayOutRows(program, is_in_floats ? kFloatsInLane : kDoublesInLane);
  Eigen::VectorXd d;
  ShortLoops::Run(pool_, static_cast<int>(layout.parts.size()), [&](ShortLoops& loops) {
    auto& [normal, floats, doubles] = *memory_;
    normal.Take(program.gradient.size(), layout);
    if (is_in_floats) {
      floats.Take(program, layout, loops);
      d = InteriorPoint(program, to, loops, floats, normal).Run();
      if (!is_to_centre) return;
    }
    doubles.Take(program, layout, loops);
    InteriorPoint finer(program, to, loops, doubles, normal);
    d = is_to_centre ? finer.Polish(std::move(d)) : finer.Run();
  });
  return d;
}

}  // namespace capfit::tighten
