#include "tests/fuzz/body_targets.h"

#include <cstdint>

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

// Two bits for the unit, two for the axis; with the next bit a landmark from the caller.
body::BodyOptions OptionsFrom(std::uint8_t switches, ByteSource& source) {
  body::BodyOptions options;
  options.unit = static_cast<body::Unit>(switches & 3);
  options.up = static_cast<body::UpAxis>((switches >> 2) & 3);
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
