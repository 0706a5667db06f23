// What is in a mesh file, and what a fit makes of it, for people and programs.
#ifndef CAPFIT_CLIENT_INSPECTION_H_
#define CAPFIT_CLIENT_INSPECTION_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/body/find_body.h"
#include "core/character/find_character.h"
#include "core/formats/polygon_soup.h"
#include "core/pipeline/fit.h"

namespace capfit::client {

// An arm or a leg: how it is held.
struct LimbPose {
  std::string limb;          // "left_arm"
  double from_down_deg = 0;  // from straight down, [0, 180]
};

struct Inspection {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t joints = 0;
  std::vector<std::string> known_joints;  // landmarks that the skeleton tells: "left_elbow"
  // What became of each part. One entry where the mesh is one surface.
  std::vector<character::CharacterPart> parts;
  // Nothing where no body was found.
  std::optional<body::Unit> unit;
  std::optional<body::UpAxis> up;  // kAuto where no positive axis points up
  double height_m = 0.0;
  bool is_solid = false;  // a solid was made around several surfaces
  std::vector<LimbPose> pose;
  std::vector<Warning> warnings;
  absl::Status status;  // why no body was found
};

// The way of a fit as far as the body. Never fails: what went wrong is in `status`.
[[nodiscard]] Inspection Inspect(const formats::PolygonSoup& soup,
                                 const pipeline::FitOptions& options, const ThreadPool& pool);

// Lines and a table that end with a newline.
[[nodiscard]] std::string InspectionTable(const Inspection& inspection);
// One object, indented, with a newline at the end.
[[nodiscard]] std::string InspectionJson(const Inspection& inspection);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_INSPECTION_H_
