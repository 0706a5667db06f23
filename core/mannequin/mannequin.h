// The built-in parametric mannequin: a closed, smooth, human surface from a few measures.
#ifndef CAPFIT_CORE_MANNEQUIN_MANNEQUIN_H_
#define CAPFIT_CORE_MANNEQUIN_MANNEQUIN_H_

#include <cstdint>
#include <optional>

#include "absl/status/statusor.h"
#include "core/formats/polygon_soup.h"

namespace capfit::mannequin {

enum class MannequinSex { kFemale, kMale };
enum class MannequinPose {
  kT,
  kA,
  kSides
};  // arms level; 45 degrees down; 15 degrees from the body

// Where the girths are taken, as a part of the body's height: a level tape, pulled tight (it spans
// the hollows between the breasts and along the spine).
inline constexpr double kBustLevel = 0.720;
inline constexpr double kWaistLevel = 0.627;
inline constexpr double kHipLevel = 0.515;

// Metres; Y up, facing +Z, soles at y = 0, left at +X. Measures left out follow from sex and
// height.
struct MannequinOptions {
  MannequinSex sex = MannequinSex::kFemale;
  MannequinPose pose = MannequinPose::kA;
  double height_m = 1.70;         // [0.8, 2.3], of the whole body, whatever is cut off
  std::optional<double> bust_m;   // girths; [0.5, 1.8], and at most 1 / 3 from the usual for the
  std::optional<double> waist_m;  // height (waist: 1 / 2), lest the figure stop being human
  std::optional<double> hip_m;
  std::optional<double> arm_angle_rad;  // upper arm from straight down, [0.15, 2]; overrides pose
  int faces = 20'000;                   // [2000, 500000]; the mesh has this many within 20 %
  bool quads = true;                    // otherwise triangles
  bool with_head = true;                // without: cut flat and closed, like a tailor's mannequin;
  bool with_hands = true;               // what is left stays where it was
  bool with_feet = true;
};

// The mesh is closed and manifold (Euler number 2), its faces turn outward, it is the mirror image
// of itself in x = 0 bit for bit (vertex by vertex and face by face), and its girths are the wanted
// ones to 1 %. INVALID_ARGUMENT names the option and its range. Same options, same bits. About 0.1
// s for 20 000 faces and 1 s for 500 000.
[[nodiscard]] absl::StatusOr<formats::PolygonSoup> MakeMannequin(const MannequinOptions& options);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_MANNEQUIN_H_
