#include "tests/fuzz/body_targets.h"

#include <cstdint>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/find_body.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/fuzz/body_promises.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/dented_body.h"
#include "tests/fuzz/mesh_promises.h"
#include "tests/fuzz/mesh_targets.h"

namespace capfit::fuzz {
namespace {

struct UsualJoint {
  const char* name;
  double x_m;
  double y_m;
};
// Of somebody of 1.7 m with the arms half raised.
constexpr UsualJoint kUsualJoints[] = {
    {"Neck", 0.0, 1.42},           {"Head", 0.0, 1.52},        {"LeftArm", 0.17, 1.36},
    {"LeftForeArm", 0.36, 1.18},   {"LeftHand", 0.53, 1.02},   {"LeftUpLeg", 0.1, 0.9},
    {"LeftLeg", 0.12, 0.5},        {"LeftFoot", 0.13, 0.09},   {"RightArm", -0.17, 1.36},
    {"RightForeArm", -0.36, 1.18}, {"RightHand", -0.53, 1.02}, {"RightUpLeg", -0.1, 0.9},
    {"RightLeg", -0.12, 0.5},      {"RightFoot", -0.13, 0.09}};

// Those moved by up to 13 cm, or where the scale says so by up to metres.
std::vector<formats::NamedJoint> SkeletonFrom(ByteSource& source) {
  std::vector<formats::NamedJoint> joints;
  const double step_m = source.Next() % 2 == 0 ? 0.001 : 0.03;
  for (const UsualJoint& usual : kUsualJoints) {
    formats::NamedJoint& joint = joints.emplace_back();
    joint.name = usual.name;
    joint.position = {usual.x_m, usual.y_m, 0.0};
    for (double& coordinate : joint.position) coordinate += step_m * source.NextSigned();
  }
  return joints;
}

// Two bits for the unit, two for the axis; with the next bit a landmark from the caller, with bit 6
// a skeleton.
body::BodyOptions OptionsFrom(std::uint8_t switches, ByteSource& source) {
  body::BodyOptions options;
  options.unit = static_cast<body::Unit>(switches & 3);
  options.up = static_cast<body::UpAxis>((switches >> 2) & 3);
  if ((switches & 64) != 0) options.skeleton = SkeletonFrom(source);
  if ((switches & 16) == 0) return options;
  const auto id = static_cast<body::LandmarkId>(source.Next() % body::kLandmarkCount);
  Eigen::Vector3d position;
  for (double& coordinate : position) coordinate = 0.02 * source.NextSigned();
  options.landmarks[id] = position;
  return options;
}

}  // namespace

std::string TryFindBody(std::span<const std::byte> bytes) {
  static const ThreadPool& pool = *new ThreadPool(1);  // never destroyed: safe at exit
  ByteSource source(bytes);
  const std::uint8_t switches = source.Next();
  const body::BodyOptions options = OptionsFrom(switches, source);
  const formats::PolygonSoup soup =
      (switches & 32) != 0 ? SoupFrom(source.Take(bytes.size())) : DentedBody(source);
  const auto prepared = mesh::PrepareMesh(soup);
  if (!prepared.ok()) return {};
  const NullObserver observer;
  return BrokenPromiseOfBody(body::FindBody(prepared->mesh, options, pool, observer));
}

}  // namespace capfit::fuzz
