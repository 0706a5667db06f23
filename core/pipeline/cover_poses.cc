#include "core/pipeline/cover_poses.h"

#include <cstdint>
#include <optional>
#include <vector>

#include "core/coverage/cover_body.h"
#include "core/pipeline/bind_spheres.h"
#include "core/pipeline/to_caller_frame.h"
#include "core/skinning/bone_weights.h"

namespace capfit::pipeline {
namespace {

constexpr double kGapAccuracy = 0.05;  // of the gap that coverage allows

std::vector<Eigen::Vector3d> InDouble(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3d> doubles;
  doubles.reserve(points.size());
  for (const Eigen::Vector3f& p : points) doubles.push_back(p.cast<double>());
  return doubles;
}

// For each point of the target a vertex of the caller's that lies there.
std::vector<std::uint32_t> SourcesOfTarget(const BodyAtRest& rest) {
  const body::EnclosedSurface surface = rest.body.enclosed();
  std::vector<std::uint32_t> source(surface.vertices_m.size(), 0);
  for (std::size_t s = surface.vertex_of_source.size(); s-- > 0;) {
    const std::int32_t vertex = surface.vertex_of_source[s];
    if (vertex >= 0) source[vertex] = static_cast<std::uint32_t>(s);
  }
  std::vector<std::uint32_t> sources;
  for (const std::uint32_t vertex : rest.target.vertices) sources.push_back(source[vertex]);
  return sources;
}

motion::MotionFrames TargetInFrames(const BodyAtRest& rest, const Motion& motion,
                                    const ThreadPool& pool) {
  const std::vector<std::uint32_t> sources = SourcesOfTarget(rest);
  motion::MotionFrames points(motion.frames.size());
  pool.ForEach(points.size(), [&](std::size_t f) {
    for (const std::uint32_t source : sources) {
      points[f].push_back(
          rest.body.body_from_caller.Apply(motion.frames[f][source].cast<double>()));
    }
  });
  return points;
}

// In the body's frame at rest.
motion::MotionFrames CentersInFrames(const BodyAtRest& rest, const FitOptions& options,
                                     const ThreadPool& pool, FitObserver& observer,
                                     const capsule::PrimitiveSet& at_rest) {
  const Motion& motion = *options.motion;
  skinning::SparseWeights sparse = BindSparse(rest.body, CentersOf(at_rest), pool, observer);
  std::optional<skinning::BoneWeights> bones;
  if (options.skinning == SkinningMode::kBones) {
    const std::vector<Eigen::Vector3d> centers =
        CentersOf(ToCallerFrame(at_rest, rest.body.body_from_caller.Inverse()));
    skinning::MakeExact(rest.soup.positions, centers, sparse);
    bones = skinning::BonesOfSparse(sparse, centers, rest.soup);
  }
  motion::MotionFrames centers(motion.frames.size());
  pool.ForEach(centers.size(), [&](std::size_t f) {
    centers[f] = bones ? skinning::Apply(*bones, motion.joints[f])
                       : skinning::Apply(sparse, InDouble(motion.frames[f]));
    for (Eigen::Vector3d& center : centers[f]) center = rest.body.body_from_caller.Apply(center);
  });
  return centers;
}

}  // namespace

motion::MotionReport CoverPoses(const BodyAtRest& rest, const FitOptions& options,
                                const ThreadPool& pool, FitObserver& observer,
                                capsule::PrimitiveSet& set, double& max_gap_m) {
  motion::MotionOptions motion_options;
  motion_options.cover.tolerance_m = options.tolerance_m;
  motion_options.radii = options.motion->radii;
  const auto carry = [&](const capsule::PrimitiveSet& at_rest) {
    return CentersInFrames(rest, options, pool, observer, at_rest);
  };
  motion::MotionReport report =
      motion::CoverMotion(rest.target, TargetInFrames(rest, *options.motion, pool), carry,
                          motion_options, pool, observer, set);
  max_gap_m =
      coverage::CertifiedGap(rest.target, set, kGapAccuracy * motion_options.cover.max_gap_m, pool);
  return report;
}

}  // namespace capfit::pipeline
