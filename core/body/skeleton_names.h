// What the joints of common humanoid skeletons are called.
#ifndef CAPFIT_CORE_BODY_SKELETON_NAMES_H_
#define CAPFIT_CORE_BODY_SKELETON_NAMES_H_

#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/body/anatomy.h"
#include "core/formats/polygon_soup.h"

namespace capfit::body {

// Shoulders, elbows, wrists, hips, knees, ankles and the neck among `joints`, by their names: those
// of Mixamo ("mixamorig:LeftForeArm"), VRM and VRoid ("leftLowerArm", "J_Bip_L_LowerArm", "Left
// elbow"), MakeHuman ("lowerarm01.L"), SMPL ("L_Elbow", "left_elbow"), Unreal ("lowerarm_l"), 3ds
// Max Biped ("Bip01 L Forearm") and Blender's Rigify ("forearm.L"). Case and separators do not
// matter. Where two skeletons use a word for different joints ("LeftShoulder" is Mixamo's collar
// bone and SMPL's shoulder joint; "LeftLeg" is a shin or a thigh) the other joints tell which is
// meant. Joints that are not there or unknown are left out; of several by one name the first
// counts. Positions as given.
[[nodiscard]] std::map<LandmarkId, Eigen::Vector3d> LandmarksFromSkeleton(
    const std::vector<formats::NamedJoint>& joints);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SKELETON_NAMES_H_
