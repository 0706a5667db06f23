// The set as two tables, for spreadsheets and scripts.
#ifndef CAPFIT_CORE_EXPORT_TABLE_H_
#define CAPFIT_CORE_EXPORT_TABLE_H_

#include "core/export/collider_set.h"

namespace capfit::exports {

// spheres.csv and capsules.csv in YUpFrame(), metres: what the file says of itself in lines that
// begin with '#', a line of column names with units, a line for each sphere or capsule in their
// order.
//
//   spheres:  index, name, part, joint (its name; empty without a rig), x_m, y_m, z_m, radius_m,
//             is_lone (1: no capsule uses it), joint_x_m, joint_y_m, joint_z_m (the centre in the
//             joint's own frame, see JointFrame; without a joint the centre)
//   capsules: index, name, part, joint, first_sphere, second_sphere (indices), length_m
//             (between the centres), first_radius_m, second_radius_m, is_sphere (1: one sphere is
//             in the other)
//
// No warnings: nothing is lost.
[[nodiscard]] Exported WriteTables(const ColliderSet& set);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_TABLE_H_
