// Fits a body in this process, without a server, and prints its spheres and capsules:
//   fit_here BODY.obj
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include "core/formats/read_mesh.h"
#include "core/pipeline/fit.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: fit_here BODY\n"), 1;
  std::ifstream in(argv[1], std::ios::binary);
  const std::string file(std::istreambuf_iterator<char>(in), {});
  const auto mesh = capfit::formats::ReadMesh(std::as_bytes(std::span(file)));
  if (!mesh.ok()) return std::fprintf(stderr, "%s\n", mesh.status().ToString().c_str()), 1;

  capfit::pipeline::FitOptions options;
  options.max_spheres = 32;
  options.max_capsules = 32;
  capfit::NullObserver observer;
  const auto result = capfit::pipeline::Fit(*mesh, options, capfit::ThreadPool(), observer);
  if (!result.ok()) return std::fprintf(stderr, "%s\n", result.status().ToString().c_str()), 1;

  // 17 digits: reading them gives the same bits again.
  for (const auto& [center, radius] : result->primitives.spheres) {
    std::printf("sphere %.17g %.17g %.17g %.17g\n", center.x(), center.y(), center.z(), radius);
  }
  for (const auto& [first, second] : result->primitives.capsules) {
    std::printf("capsule %d %d\n", first, second);
  }
  return 0;
}
