// The feature polygons of a body (paper, III-A and III-E): which planes, and what they cut.
#ifndef CAPFIT_CORE_SECTION_FEATURE_POLYGON_H_
#define CAPFIT_CORE_SECTION_FEATURE_POLYGON_H_

#include <optional>
#include <string>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/body/body.h"
#include "core/geometry/plane_frame.h"
#include "core/section/polygon.h"

namespace capfit::section {

enum class Sex { kAuto, kFemale, kMale };  // kFemale: split the bust at any valley; kMale: never

struct SectionOptions {
  // Planes on each chain (torso, arm, leg); the paper's twenty are 6, 3 and 4. At least 2.
  int torso_polygons = 6;
  int arm_polygons = 3;
  int leg_polygons = 4;
  Sex sex = Sex::kAuto;
  int outline_points = 128;  // vertices of each outline after resampling
  body::PartSelection parts;
};

// An outline cut into pieces that are fitted one by one (paper, III-E): indices of its vertices,
// each piece at least 3. Circles are still judged against the whole outline.
struct PolygonSplit {
  std::vector<std::vector<int>> pieces;
};

// The boundary of one cross section, perpendicular to the medial curve of its chain.
struct FeaturePolygon {
  body::Part chain = body::Part::kTorso;
  std::string name;                   // "hip", "waist", "left_knee", ...
  int order = 0;                      // place along its chain, 0 next to the trunk (torso: lowest)
  double arc_length_m = 0.0;          // on the chain's medial curve
  geometry::PlaneFrame frame;         // x axis towards the body's left where that is possible
  Polygon outline;                    // in `frame`
  std::optional<PolygonSplit> split;  // hip and bust only
  // Index of the polygon on the other side when the body is symmetric; its own index on the trunk;
  // -1 otherwise.
  int mirror = -1;
};

struct FeaturePolygons {
  std::vector<FeaturePolygon> polygons;  // by chain, then by order
  std::vector<Warning> warnings;
  double breast_height_ratio = 0.0;  // height of the breasts / width of the chest (III-E)
  bool bust_is_split = false;
};

// Cuts the body. Planes go through the landmarks; more planes than landmarks are spread between
// them, fewer keep the most telling ones. O(planes * faces), planes in parallel. Nothing comes back
// where the observer cancels.
[[nodiscard]] FeaturePolygons ExtractFeaturePolygons(const body::Body& body,
                                                     const SectionOptions& options,
                                                     const ThreadPool& pool,
                                                     const FitObserver& observer);

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_FEATURE_POLYGON_H_
