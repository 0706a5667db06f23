// What growing asks of either guise of refinement: settle a set, judge it, and try an edit nearby.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_OBJECTIVE_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_OBJECTIVE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/capsule/mirrored_set.h"
#include "core/refine/graph/graph_edit.h"

namespace capfit::refine {

enum class Effort {
  kRough,    // from a start whose places and radii are guesses
  kTouch,    // a few steps after edits
  kTighten,  // from a set that is finished but for what has been added to the task since
  kFinish,   // until nothing is left to gain
};

// A glance costs a third of a thorough trial and tells which edits are worth one.
enum class Trial { kGlance, kThorough };

// All values are relative to the volume of the fitted parts; lower is better. Implementations are
// immutable and may be asked from several threads.
class Objective {
 public:
  virtual ~Objective() = default;

  // Moves and grows all spheres.
  virtual void Settle(Effort effort, capsule::MirroredSet& graph) const = 0;

  // E_r, plus a penalty for what the guise forbids.
  [[nodiscard]] virtual double Value(const capsule::MirroredSet& graph) const = 0;

  // What many edits of the same graph share: made once per round.
  class Round {
   public:
    virtual ~Round() = default;
    // Settles the surroundings of the edit within edited.graph, a little or as far as pays;
    // returns by how much the value falls against the graph without the edit.
    virtual double Try(Trial trial, EditedGraph& edited) const = 0;
  };
  [[nodiscard]] virtual std::unique_ptr<Round> StartRound(
      const capsule::MirroredSet& graph) const = 0;

  // Points of the surface where a new sphere would help most, best first, apart from each other.
  [[nodiscard]] virtual std::vector<Eigen::Vector3d> WorstPoints(const capsule::MirroredSet& graph,
                                                                 int count) const = 0;
};

// The first `count` points in falling order of score that keep `apart_m` from all earlier ones;
// scores of 0 and less are left out. Ties go to the lower index.
[[nodiscard]] std::vector<Eigen::Vector3d> BestApart(const std::vector<Eigen::Vector3d>& points_m,
                                                     const std::vector<double>& scores,
                                                     double apart_m, int count);

// A box around everything that the nodes marked `active` shape, with a margin.
[[nodiscard]] Eigen::AlignedBox3d ReachOf(const capsule::MirroredSet& graph,
                                          const std::vector<char>& active);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_OBJECTIVE_H_
