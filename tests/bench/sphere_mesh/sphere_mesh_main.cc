// The Sphere-Meshes baseline of the evaluation.
//
//   sphere_mesh BODY PREFIX [--budgets 64,32,...] [--radius-bounds 0.75,1,1.5,0]
//               [--steps collapse|drop|settle] [--sag-mm 0]
//
// Writes PREFIX.N.json for each budget N of primitives, all in the unit and frame of BODY: the best
// of what all radius bounds give (see fit_sphere_mesh.h for the steps). `--radius-bounds 0.75
// --steps collapse` is Sphere-Meshes as published, in one setting. "seconds" in it is what a run
// for that budget alone takes, without reading and preparing the mesh. With --sag-mm (in
// thousandths of the file's unit) also PREFIX.N.capsules.json, the same solid without triangles.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/prepare_mesh.h"
#include "tests/bench/read_body.h"
#include "tests/bench/sphere_mesh/fit_sphere_mesh.h"

namespace capfit::bench {
namespace {

struct Arguments {
  std::string body, prefix;
  std::vector<int> budgets = {346, 299, 250, 207, 167, 128, 95, 64, 48, 32, 22};
  FitOptions options;
  double sag_mm = 0.0;
};

bool Write(const std::string& file_name, const std::string& text) {
  std::ofstream file(file_name, std::ios::binary);
  file << text;
  file.close();
  if (!file) std::fprintf(stderr, "sphere_mesh: cannot write %s\n", file_name.c_str());
  return static_cast<bool>(file);
}

bool WriteAll(const Arguments& arguments, int budget, const SphereMesh& mesh, double seconds) {
  const std::string name = arguments.prefix + "." + std::to_string(budget);
  if (!Write(name + ".json", ToJson(mesh, seconds))) return false;
  if (arguments.sag_mm <= 0.0) return true;
  return Write(name + ".capsules.json",
               ToJson(WithoutTriangles(mesh, 1e-3 * arguments.sag_mm), seconds));
}

int Run(const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const auto body = mesh::PrepareMesh(ReadBodyOrExit(arguments.body));
  if (!body.ok()) {
    std::fprintf(stderr, "sphere_mesh: %s\n", body.status().ToString().c_str());
    return 1;
  }
  const Clock::time_point start = Clock::now();
  const int most = *std::max_element(arguments.budgets.begin(), arguments.budgets.end());
  const SphereMeshFitter fitter(body->mesh, most, arguments.options);
  const double collapse_s = since(start);
  for (const int budget : arguments.budgets) {
    const Clock::time_point fit_start = Clock::now();
    const SphereMesh mesh = fitter.Fit(budget);
    if (!WriteAll(arguments, budget, mesh, collapse_s + since(fit_start))) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace capfit::bench

int main(int argc, char** argv) {
  using capfit::bench::Steps;
  capfit::bench::Arguments arguments;
  CLI::App app{"A body as a sphere mesh (Thiery, Guy, Boubekeur 2013, and steps of later papers)"};
  app.add_option("BODY", arguments.body, "Mesh file")->required();
  app.add_option("PREFIX", arguments.prefix, "Start of the names of the files to write")
      ->required();
  app.add_option("--budgets", arguments.budgets, "Primitives: spheres, cones, 2 for a triangle")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--radius-bounds", arguments.options.radius_bounds,
                 "Largest radius / least width of the surface it stands for; 0: none. "
                 "The best of all is written")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber);
  app.add_option("--steps", arguments.options.steps, "How far to go: collapse, drop or settle")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Steps>{
          {"collapse", Steps::kCollapse}, {"drop", Steps::kDrop}, {"settle", Steps::kSettle}}));
  app.add_option("--sag-mm", arguments.sag_mm, "Write the solid without triangles too")
      ->check(CLI::NonNegativeNumber);
  CLI11_PARSE(app, argc, argv);
  return capfit::bench::Run(arguments);
}
