// From the caller's mesh to the body that is fitted: the way through mesh, character, solid and
// body.
#ifndef CAPFIT_CORE_PIPELINE_TAKE_BODY_H_
#define CAPFIT_CORE_PIPELINE_TAKE_BODY_H_

#include <Eigen/Core>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/body/body.h"
#include "core/character/find_character.h"
#include "core/formats/polygon_soup.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {

struct TakenBody {
  body::Body body;
  // What became of each part of the file; empty where the mesh is one surface, taken as it came.
  std::vector<character::CharacterPart> parts;
  // Of what was taken, in the caller's frame and unit.
  Eigen::Vector3d box_min = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_max = Eigen::Vector3d::Zero();
};

// One surface is mended where it needs that (mesh room) and keeps its vertices. A file of several
// parts, or a surface that cannot be mended, is looked at part by part (character room); if what
// belongs to the character is one surface, that is mended; else one solid is made around all of it
// (solid room), and body.shells holds the surfaces themselves. Without a skeleton the parts are
// judged a second time, with the landmarks found the first time, and if that changes what belongs
// to the character, the body is made anew. Of the options those of the mesh count: unit, up,
// landmarks, character and require_parts. Adds to `warnings`, also before an error.
[[nodiscard]] absl::StatusOr<TakenBody> TakeBody(const formats::PolygonSoup& soup,
                                                 const FitOptions& options, const ThreadPool& pool,
                                                 FitObserver& observer,
                                                 std::vector<Warning>& warnings);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_TAKE_BODY_H_
