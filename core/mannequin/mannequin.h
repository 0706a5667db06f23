// The built-in parametric mannequin: a closed, smooth, human surface from a few measures.
#ifndef CAPFIT_CORE_MANNEQUIN_MANNEQUIN_H_
#define CAPFIT_CORE_MANNEQUIN_MANNEQUIN_H_

#include <cstdint>
#include <optional>

#include "absl/status/statusor.h"
#include "core/mesh/polygon_soup.h"

namespace capfit::mannequin {

enum class MannequinSex { kFemale, kMale };
enum class MannequinPose {
  kT,
  kA,
  kSides
};  // arms level; 45 degrees down; 15 degrees from the body

// Metres; Y up, facing +Z, soles at y = 0, left at +X. Measures left out follow from sex and
// height.
struct MannequinOptions {
  MannequinSex sex = MannequinSex::kFemale;
  MannequinPose pose = MannequinPose::kA;
  double height_m = 1.70;        // [0.8, 2.3]
  std::optional<double> bust_m;  // girths; [0.5, 1.8]
  std::optional<double> waist_m;
  std::optional<double> hip_m;
  std::optional<double> arm_angle_rad;  // upper arm from straight down; overrides the pose
  int faces = 20'000;                   // [2000, 500000]; the mesh has this many within 20 %
  bool quads = true;                    // otherwise triangles
  bool with_head = true;                // without: cut flat and closed, like a tailor's mannequin
  bool with_hands = true;
  bool with_feet = true;
};

// INVALID_ARGUMENT names the option and its range. Same options, same bits.
[[nodiscard]] absl::StatusOr<mesh::PolygonSoup> MakeMannequin(const MannequinOptions& options);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_MANNEQUIN_H_
