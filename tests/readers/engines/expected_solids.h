// What a program must find in the files beside expected.json.
#ifndef CAPFIT_TESTS_READERS_ENGINES_EXPECTED_SOLIDS_H_
#define CAPFIT_TESTS_READERS_ENGINES_EXPECTED_SOLIDS_H_

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/geometry/tapered_capsule.h"

namespace capfit::readers {

struct ExpectedSolid {
  std::string name;
  std::vector<std::string> sphere_names;  // two, or one
  geometry::TaperedCapsule hull;          // metres, Y up; a lone sphere twice
  int joint = -1;                         // -1: none
};

enum class When { kAtRest, kPosed };

// Of FOLDER/expected.json. Ends the program with what is wrong where it cannot be read.
[[nodiscard]] std::vector<ExpectedSolid> ExpectedSolids(const std::string& folder,
                                                        When when = When::kAtRest);

// How a joint has moved in the pose since rest, metres, Y up; of -1, or at rest, not at all.
class JointMoves {
 public:
  JointMoves(const std::string& folder, When when);
  [[nodiscard]] Eigen::Isometry3d Of(int joint) const;

 private:
  std::vector<Eigen::Isometry3d> moves_;
};

// The bytes of a file, and JSON of them; end the program where it cannot be read.
[[nodiscard]] std::string FileText(const std::string& path);
[[nodiscard]] nlohmann::json FileJson(const std::string& path);

// `count` directions of length 1, evenly around.
[[nodiscard]] std::vector<Eigen::Vector3d> Directions(int count);

// Points of the hull's surface, over its ends and along its cone.
[[nodiscard]] std::vector<Eigen::Vector3d> SurfacePoints(const geometry::TaperedCapsule& hull,
                                                         int count);

// Counts what is wrong and says the first of it.
class Failures {
 public:
  void Check(bool is_so, const std::string& message);
  void Near(double value, double expected, double tolerance, const std::string& message);
  // Says "ok" or how many failed; the program's exit code.
  [[nodiscard]] int Finish(const std::string& message) const;

 private:
  int count_ = 0;
};

}  // namespace capfit::readers

#endif  // CAPFIT_TESTS_READERS_ENGINES_EXPECTED_SOLIDS_H_
