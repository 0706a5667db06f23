// What the joints of common humanoid skeletons are called.
#ifndef CAPFIT_CORE_BODY_SKELETON_NAMES_H_
#define CAPFIT_CORE_BODY_SKELETON_NAMES_H_

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "core/body/anatomy.h"
#include "core/formats/polygon_soup.h"

namespace capfit::body {

// The joints of a skeleton that say something of the body. Positions as given.
struct Rig {
  // Shoulders, elbows, wrists, hips, knees, ankles and the neck.
  std::map<LandmarkId, Eigen::Vector3d> landmarks;
  std::optional<Eigen::Vector3d> head;  // where it sits on the neck

  [[nodiscard]] std::optional<Eigen::Vector3d> at(LandmarkId id) const {
    const auto found = landmarks.find(id);
    return found == landmarks.end() ? std::nullopt : std::optional(found->second);
  }
};

// Finds them among `joints`: by what the file says they are (VRM's human bones), else by their
// names: those of Mixamo ("mixamorig:LeftForeArm") and Ready Player Me ("LeftForeArm"), VRM and
// VRoid ("leftLowerArm", "J_Bip_L_LowerArm", "Left elbow"), MakeHuman ("lowerarm01.L"), SMPL
// ("L_Elbow", "left_elbow"), Unreal ("lowerarm_l"), Character Creator ("CC_Base_L_Forearm"), Daz
// ("lForearmBend"), 3ds Max Biped ("Bip01 L Forearm"), Blender's Rigify ("forearm.L") and
// MikuMikuDance ("左ひじ", or "ひじ.L" as Blender has it). Case and
// separators do not matter, nor does what most names begin with ("Bob:LeftArm") or a number of its
// own that each name ends with ("LeftArm_07"). Where two skeletons use a word for different joints
// ("LeftShoulder" is Mixamo's collar bone and SMPL's shoulder joint; "LeftLeg" is a shin or a
// thigh) the other joints tell which is meant. Joints that are not there or unknown are left out;
// of several by one name the first counts. O(joints).
[[nodiscard]] Rig ReadRig(const std::vector<formats::NamedJoint>& joints);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SKELETON_NAMES_H_
