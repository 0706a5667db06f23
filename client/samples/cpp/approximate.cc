// Fits a body on a capfit server and prints its spheres and capsules:
//   approximate HOST:PORT BODY.obj
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include "client/body_client.h"

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: approximate HOST:PORT BODY\n"), 1;
  std::ifstream in(argv[2], std::ios::binary);
  const std::string file(std::istreambuf_iterator<char>(in), {});

  capfit::pipeline::FitOptions options;
  options.max_spheres = 32;
  options.max_capsules = 32;
  const auto client = capfit::client::BodyClient::Connect(argv[1]);
  const auto result = client.ApproximateFile(std::as_bytes(std::span(file)),
                                             capfit::formats::MeshFormat::kUnknown, options);
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
