// Which of the tips that a surface runs out into is which: head, hands, feet.
#ifndef CAPFIT_CORE_BODY_TIP_ROLES_H_
#define CAPFIT_CORE_BODY_TIP_ROLES_H_

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/body/branches.h"
#include "core/body/extremities.h"
#include "core/body/rig_ends.h"

namespace capfit::body {

// A tip that may be an extremity.
struct TipCandidate {
  int branch = 0;
  double girth = 0.0;  // mean, from its junction to the tip
  bool is_stump = false;
  double openness = 0.0;  // of an upper body's: its opening over its area, 0 to 1
  double junction = 0.0;
  std::vector<std::uint32_t> vertices;        // those farther than the junction
  std::array<bool, kRigEndCount> holds = {};  // which ends of the skeleton are among these
};

// The ends of a skeleton that a role may stand for: first and last.
[[nodiscard]] std::pair<RigEnd, RigEnd> EndsOf(Tip tip);

// What a body may lack.
enum class Cut : std::uint8_t {
  kNothing,
  kLimbs,      // an arm, a leg or both legs end anywhere: they say nothing of the ways
  kUpperBody,  // what is below the waist, the hips or the thighs: head, arms and no legs are left
};

struct TipRoles {
  std::array<int, kTipCount> candidates = {-1, -1, -1, -1, -1};  // of each role, -1: none
  bool legs_are_cut = false;                                     // both of them
  double misfit = 0.0;                                           // see Extremities
};

// The roles with which the proportions fit best: the lengths of the ways between the tips, the
// girths, both of a pair alike, few tips without a role and few roles without a tip, and no
// contradiction to the skeleton. Tries every way that the cut leaves.
[[nodiscard]] TipRoles FindTipRoles(std::span<const Branch> branches,
                                    std::span<const TipCandidate> candidates,
                                    const std::optional<RigEnds>& rig, Cut cut);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_TIP_ROLES_H_
