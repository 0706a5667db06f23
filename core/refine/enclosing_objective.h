// ENCLOSE: the least volume that holds all points.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_OBJECTIVE_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_OBJECTIVE_H_

#include <memory>
#include <vector>

#include "core/refine/cover_points.h"
#include "core/refine/objective.h"

namespace capfit::refine {

class EnclosingObjective final : public Objective {
 public:
  // `points` are folded to x >= 0 where the graphs to come are symmetric; volume_m3 > 0 is that of
  // the fitted parts.
  EnclosingObjective(CoverPoints points, double volume_m3);

  void Settle(Effort effort, CapsuleGraph& graph) const override;
  [[nodiscard]] double Value(const CapsuleGraph& graph) const override;
  [[nodiscard]] std::unique_ptr<Round> StartRound(const CapsuleGraph& graph) const override;
  [[nodiscard]] std::vector<Eigen::Vector3d> WorstPoints(const CapsuleGraph& graph,
                                                         int count) const override;

 private:
  void Loosen(double looseness, CapsuleGraph& graph) const;

  CoverPoints points_;
  double volume_m3_;
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_OBJECTIVE_H_
