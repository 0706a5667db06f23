// Real bodies in poses that nobody tuned anything for, with the joints that go with them.
#ifndef CAPFIT_TESTS_BENCH_POSE_BODY_H_
#define CAPFIT_TESTS_BENCH_POSE_BODY_H_

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "core/formats/polygon_soup.h"

namespace capfit::body {

// A body with its truth: joints by name and a segment number for each vertex.
struct TrueBody {
  formats::PolygonSoup soup;
  std::map<std::string, Eigen::Vector3d> joints;
  std::string labels;
};

// Where the bones of one side point, in degrees: 0 is straight down, positive to the side or (the
// second angle) to the front.
struct LimbPose {
  double arm_aside = 42.0;
  double arm_forward = 0.0;
  double elbow_bend = 0.0;  // forearm, further to the front than the upper arm
  double arm_inward = 0.0;  // turn of the upper arm about itself: a bent forearm points inward
  double leg_aside = 0.0;   // from where the leg is; the rest too
  double leg_forward = 0.0;
  double knee_bend = 0.0;
};

struct Pose {
  std::string name;
  LimbPose left;
  LimbPose right;
};

// The poses of the report.
[[nodiscard]] std::vector<Pose> UnseenPoses();

// `rest` must stand upright and face +Z. Each bone is turned about its joint; at the boundary of
// its segment the turn fades in over the skin nearby, as linear blend skinning does.
[[nodiscard]] TrueBody InPose(const TrueBody& rest, const Pose& pose);

}  // namespace capfit::body

#endif  // CAPFIT_TESTS_BENCH_POSE_BODY_H_
