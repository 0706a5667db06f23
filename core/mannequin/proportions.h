// The figures that make the mannequin look like a person.
#ifndef CAPFIT_CORE_MANNEQUIN_PROPORTIONS_H_
#define CAPFIT_CORE_MANNEQUIN_PROPORTIONS_H_

#include <span>

#include "core/mannequin/mannequin.h"

namespace capfit::mannequin {

// All lengths in this room, but for the options, are in body heights. The frame is the body's: Y
// up, facing +Z, left at +X, z = 0 above the ankles.

// A horizontal ring of the trunk, the neck or the head: an ellipse with its own reach to the front
// and to the back, tilted or bent as the three heights say.
struct TrunkRing {
  double y_front, y_side, y_back;
  double half_width;
  double z_front, z_side, z_back;  // where it crosses the middle in front, is widest, ends behind
  double squareness;               // exponent of the super-ellipse; 2 is an ellipse
  double bust, waist, hip;         // how much of each girth's factor it follows
};

// A ring of the leg, horizontal. The middle is on the leg's axis; z counts from the ankle's plane.
struct LegRing {
  double y, half_width, z_front, z_back;
};

// A ring of the foot like that of a sock: in the plane through a point on the instep and one on the
// heel or the sole.
struct FootRing {
  double y_top, z_top, y_bottom, z_bottom, half_width;
};

// A ring of the arm or the hand, square to the arm's axis at the distance `t` from the armhole.
struct ArmRing {
  double t;
  double half_height;  // upward when the arm is level
  double half_depth;   // towards the front
  double forward;      // of the axis
};

struct Proportions {
  std::span<const TrunkRing> trunk;  // crotch to the middle of the neck
  std::span<const TrunkRing> head;   // the rest up to the crown
  double crown_y;
  std::span<const LegRing> leg;  // crotch to ankle
  std::span<const FootRing> foot;
  std::span<const ArmRing> arm;  // shoulder to wrist
  std::span<const ArmRing> hand;
  double bust_girth, waist_girth, hip_girth;  // of the default figure, in body heights
};

// Index of the trunk rings that border the armhole: the arm leaves between them.
inline constexpr std::size_t kArmpitRing = 8;
inline constexpr std::size_t kAcromionRing = 11;

[[nodiscard]] const Proportions& ProportionsOf(MannequinSex sex);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_PROPORTIONS_H_
