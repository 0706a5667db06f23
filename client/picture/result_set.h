// RESULT.json as far as the commands that take one need it: capfit's own (docs/result.schema.json),
// or that of another program, which has spheres and capsules alone.
#ifndef CAPFIT_CLIENT_PICTURE_RESULT_SET_H_
#define CAPFIT_CLIENT_PICTURE_RESULT_SET_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/body/anatomy.h"
#include "core/character/find_character.h"
#include "core/geometry/sphere.h"
#include "core/refine/layouts/kept_layout.h"

namespace capfit::client {

// The body that a result is of.
struct ResultBodyFacts {
  std::int64_t vertex_count = 0;
  Eigen::Vector3d box_min = Eigen::Vector3d::Zero();  // in the mesh's own frame and unit
  Eigen::Vector3d box_max = Eigen::Vector3d::Zero();
};

// A cross section with the circles fitted to it, in the mesh's own frame and unit.
struct ResultPolygon {
  std::string name;  // "hip"
  std::string part;  // "torso"
  std::vector<Eigen::Vector3d> outline;
  std::vector<geometry::Sphere> circles;  // centre and radius; they lie in the outline's plane
  double outside_area_ratio = 0.0;
};

struct ResultSet {
  std::vector<geometry::Sphere> spheres;     // in the mesh's own frame and unit
  std::vector<std::array<int, 2>> capsules;  // indices into spheres
  std::vector<std::string> sphere_parts;     // same size as spheres; "" where not told
  std::vector<std::string> sphere_names;     // same size as spheres; "" where not told
  // Same size as spheres; -1 and nothing where not told.
  std::vector<int> sphere_mirrors;
  std::vector<std::optional<refine::BodyPlace>> sphere_places;
  std::map<std::string, Eigen::Vector3d> landmarks;
  std::map<std::string, double> metrics;  // the whole's, those that are numbers: "volume_error"
  std::vector<ResultPolygon> polygons;    // where they were asked for

  // Of capfit's own results only.
  std::string unit;                                 // "centimetre"; "" where not told
  std::optional<double> metres_per_unit;            // how long the mesh's unit is
  std::optional<ResultBodyFacts> body;              // what was fitted
  std::optional<body::PartSelection> parts;         // what was asked for
  std::vector<std::string> fitted_parts;            // what was there and was fitted: "left_arm"
  character::CharacterOptions character;            // which parts of the file were asked for
  std::string quality;                              // "paper"; "" where not told
  std::string engine;                               // whose limits held; "" for none
  std::optional<Eigen::Matrix3d> body_from_caller;  // the turn from the mesh's axes to the body's
  std::string capsule_profile;                      // what coverage was proved for: "tangent_hull"
  std::string version;                              // of the capfit that fitted it
};

// The layout of a result, to be kept on another body (`--layout FILE`). INVALID_ARGUMENT where the
// result has no names or parts of a body: it is not capfit's own.
[[nodiscard]] absl::StatusOr<refine::KeptLayout> LayoutOf(const ResultSet& result);

// Landmarks may be plain lists [x, y, z] too. Errors: INVALID_ARGUMENT naming the member
// ("capsules[3][1] is 40, must be below 32"), also for a format_version of a later capfit.
[[nodiscard]] absl::StatusOr<ResultSet> ParseResultSet(const std::string& json_text);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_RESULT_SET_H_
