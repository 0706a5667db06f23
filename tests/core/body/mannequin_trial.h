// A mannequin by lot, battered as scans and exports are, and whether its landmarks are found.
#ifndef CAPFIT_TESTS_CORE_BODY_MANNEQUIN_TRIAL_H_
#define CAPFIT_TESTS_CORE_BODY_MANNEQUIN_TRIAL_H_

#include <cstdint>
#include <string>
#include <vector>

#include "core/body/find_body.h"
#include "core/formats/polygon_soup.h"
#include "core/geometry/similarity.h"
#include "core/mannequin/mannequin.h"

namespace capfit::body {

struct MannequinTrial {
  mannequin::MannequinOptions options;
  formats::PolygonSoup whole;     // as made: metres, Y up, facing +Z
  formats::PolygonSoup battered;  // what is to be understood
  geometry::Similarity battered_from_whole;
  bool is_mirrored = false;  // left and right exchanged before it was turned
  double noise_m = 0.0;
  double dropped = 0.0;  // share of the faces

  // "female 1.62 m, 3110 faces, arms 63 degrees, mirrored, noise 2 mm, 5 % of faces dropped"
  [[nodiscard]] std::string Description() const;
};

// Random measures, pose and density (RandomMannequin), turned anyhow, in a random place, every
// other one mirrored; noise (normal, 2 mm in each direction) on two in three and 5 % of the faces
// dropped from two in three. Same seed, same trial.
[[nodiscard]] MannequinTrial MakeMannequinTrial(std::uint64_t seed);

// What is wrong with the body found: a landmark that is missing, outside the surface (joints), off
// it (tips), on the wrong side or not within its own part, by the measures the mannequin was made
// with. Empty: nothing.
[[nodiscard]] std::vector<std::string> FaultsOf(const Body& body, const MannequinTrial& trial);

}  // namespace capfit::body

#endif  // CAPFIT_TESTS_CORE_BODY_MANNEQUIN_TRIAL_H_
