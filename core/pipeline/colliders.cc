#include "core/pipeline/colliders.h"

#include <utility>

#include "core/pipeline/engines.h"

namespace capfit::pipeline {

exports::ColliderSet CollidersOf(const FitResult& result, std::string source) {
  exports::ColliderSet set;
  set.primitives = result.primitives;
  set.sphere_names = result.sphere_names;
  set.body_from_mesh = result.body_from_caller;
  set.joints = result.joints;
  set.sphere_joints = result.sphere_joints;
  set.capsule_joints = result.capsule_joints;
  set.profile = ProfileOf(result.effective_options);
  set.source = std::move(source);
  set.version = result.version;
  return set;
}

}  // namespace capfit::pipeline
