// The Sphere-Meshes baseline of the evaluation.
//
//   sphere_mesh BODY PREFIX [--budgets 64,32,...] [--radius-bound 0.75] [--sag-mm 0]
//
// Writes PREFIX.N.json for each budget N of primitives, all in the unit and frame of BODY.
// "seconds" in it is what a run to that budget takes, without reading and preparing the mesh. With
// --sag-mm (in thousandths of the file's unit) also PREFIX.N.capsules.json, the same solid without
// triangles.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/prepare_mesh.h"
#include "core/mesh/read_mesh.h"
#include "tests/bench/sphere_mesh/collapse_edges.h"

namespace capfit::bench {
namespace {

struct Arguments {
  std::string body, prefix;
  std::vector<int> budgets = {346, 299, 250, 207, 167, 128, 95, 64, 48, 32, 22};
  CollapseOptions options;
  double sag_mm = 0.0;
};

absl::StatusOr<mesh::PreparedMesh> ReadBody(const std::string& file_name) {
  std::ifstream file(file_name, std::ios::binary);
  if (!file) return absl::NotFoundError("cannot read " + file_name);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto soup =
      mesh::ReadMesh(std::as_bytes(std::span(bytes)), mesh::FormatFromFileName(file_name));
  if (!soup.ok()) return soup.status();
  return mesh::PrepareMesh(*soup);
}

bool Write(const std::string& file_name, const std::string& text) {
  std::ofstream file(file_name, std::ios::binary);
  file << text;
  file.close();
  if (!file) std::fprintf(stderr, "sphere_mesh: cannot write %s\n", file_name.c_str());
  return static_cast<bool>(file);
}

int Run(Arguments arguments) {
  const auto body = ReadBody(arguments.body);
  if (!body.ok()) {
    std::fprintf(stderr, "sphere_mesh: %s\n", body.status().ToString().c_str());
    return 1;
  }
  std::sort(arguments.budgets.rbegin(), arguments.budgets.rend());
  bool is_written = true;
  std::chrono::duration<double> writing{0};
  const auto start = std::chrono::steady_clock::now();
  CollapseEdges(
      body->mesh, arguments.budgets, arguments.options, [&](std::size_t i, const SphereMesh& mesh) {
        const auto pause = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(pause - start - writing).count();
        const std::string name = arguments.prefix + "." + std::to_string(arguments.budgets[i]);
        is_written &= Write(name + ".json", ToJson(mesh, seconds));
        if (arguments.sag_mm > 0.0) {
          is_written &= Write(name + ".capsules.json",
                              ToJson(WithoutTriangles(mesh, 1e-3 * arguments.sag_mm), seconds));
        }
        writing += std::chrono::steady_clock::now() - pause;
      });
  return is_written ? 0 : 1;
}

}  // namespace
}  // namespace capfit::bench

int main(int argc, char** argv) {
  capfit::bench::Arguments arguments;
  CLI::App app{"A body as a sphere mesh (Thiery, Guy, Boubekeur 2013)"};
  app.add_option("BODY", arguments.body, "Mesh file")->required();
  app.add_option("PREFIX", arguments.prefix, "Start of the names of the files to write")
      ->required();
  app.add_option("--budgets", arguments.budgets, "Primitives: spheres, cones, 2 for a triangle")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--radius-bound", arguments.options.radius_bound,
                 "Largest radius / least width of the surface it stands for; 0: none")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--sag-mm", arguments.sag_mm, "Write the solid without triangles too")
      ->check(CLI::NonNegativeNumber);
  CLI11_PARSE(app, argc, argv);
  return capfit::bench::Run(arguments);
}
