// Which points inside of a body a shell goes around: what carries limbs and what is only put on.
#ifndef CAPFIT_CORE_CHARACTER_SURROUNDING_H_
#define CAPFIT_CORE_CHARACTER_SURROUNDING_H_

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/body/anatomy.h"
#include "core/character/shells.h"

namespace capfit::character {

// Points in the middles of a body, from its joints; in the mesh's frame.
struct InnerPoints {
  std::vector<Eigen::Vector3d> trunk;
  std::vector<Eigen::Vector3d> limbs;  // arms, hands, legs and feet
  std::vector<Eigen::Vector3d> head;
  // Between the two thighs and between the knees: only a skirt goes around them.
  std::vector<Eigen::Vector3d> between_legs;
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();  // from the hips to the neck
  Eigen::Vector3d neck = Eigen::Vector3d::Zero();
  double height = 0.0;  // of the whole body, by proportion
};

// Nothing where the hips or the neck are not told. Limbs that are not told are left out.
[[nodiscard]] std::optional<InnerPoints> InnerPointsOf(
    const std::map<body::LandmarkId, Eigen::Vector3d>& joints);

// For each shell and each point, the generalised winding number (1 inside of a closed shell, 0
// outside, between them for open ones), by absolute value: shells may be inside out. Triangles far
// from a point count as dipoles: exact to a few hundredths. O(points * facets).
[[nodiscard]] std::vector<std::vector<float>> WindingNumbers(
    const Shells& shells, const std::vector<Eigen::Vector3d>& points, const ThreadPool& pool);

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_SURROUNDING_H_
