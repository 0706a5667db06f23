// Results of all kinds of fits, held against docs/result.schema.json.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "client/body_client.h"
#include "client/picture/write_mesh.h"
#include "client/result_json.h"
#include "core/mannequin/mannequin.h"
#include "tests/e2e/processes.h"

namespace capfit::e2e {
namespace {

formats::PolygonSoup Mannequin() {
  mannequin::MannequinOptions options;
  options.faces = 6000;
  return *mannequin::MakeMannequin(options);
}

formats::PolygonSoup Moved(formats::PolygonSoup soup, const Eigen::Affine3d& motion) {
  for (Eigen::Vector3d& position : soup.positions) position = motion * position;
  return soup;
}

// Fits with each list of flags; the results' paths.
std::vector<std::string> Fit(const Scratch& scratch, const std::string& name,
                             const formats::PolygonSoup& body,
                             const std::vector<std::vector<std::string>>& fits) {
  const std::string path = scratch.Path(name + ".obj");
  WriteText(path, client::ObjText(body));
  std::vector<std::string> results;
  for (const std::vector<std::string>& flags : fits) {
    results.push_back(scratch.Path(name + std::to_string(results.size()) + ".json"));
    std::vector<std::string> arguments = {"approximate", path, "-o", results.back(), "--quiet"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Outcome outcome = RunCapfit(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  return results;
}

// Skips where the validator is not installed.
void Check(std::vector<std::string> results) {
  results.insert(results.begin(), CAPFIT_RESULT_SCHEMA);
  const Outcome outcome = RunProgram(CAPFIT_CHECK_RESULTS, results);
  if (outcome.exit_code == 77) GTEST_SKIP() << "SKIPPED: no schema validator: " << outcome.out;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST(ResultSchema, HoldsForEveryKindOfFit) {
  const Scratch scratch;
  const std::string landmarks = scratch.Path("metres0.json");  // the first result itself
  Check(Fit(scratch, "metres", Mannequin(),
            {{"--local", "--request-id", "job 7"},
             {"--local", "--fit", "best", "--parts", "all", "--polygons"},
             {"--local", "--quality", "tight", "--polygons", "--max-primitives", "30"},
             {"--local", "--quality", "tight", "--fit", "best", "--max-spheres", "20"},
             {"--local", "--quality", "balanced"},
             {"--local", "--engine", "unity_cloth", "--tolerance-mm", "2"},
             {"--local", "--polygon-error", "0.5", "--require-parts", "arms,legs"},
             {"--local", "--parts", "arms,legs", "--seed", "18446744073709551615"},
             {"--local", "--landmarks", landmarks, "--sex", "male", "--heat-map"}}));
}

TEST(ResultSchema, HoldsForOtherUnitsAxesAndShapes) {
  const Scratch scratch;
  const formats::PolygonSoup body = Mannequin();
  const Eigen::Affine3d upside_down(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()) *
                                    Eigen::Scaling(1000.0));
  std::vector<std::string> results =
      Fit(scratch, "upside_down", Moved(body, upside_down), {{"--local"}});
  formats::PolygonSoup leaning = body;
  for (Eigen::Vector3d& p : leaning.positions) p.x() += 0.1 * p.y() * p.y();
  for (const std::string& path : Fit(scratch, "leaning", leaning, {{"--local", "--unit", "m"}})) {
    results.push_back(path);
  }
  Check(results);
}

TEST(ResultSchema, HoldsForArraysInCentimetresThroughAServer) {
  const Scratch scratch;
  const ServerProcess server;
  const Eigen::Affine3d to_centimetres(
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()) * Eigen::Scaling(100.0));
  pipeline::FitOptions options;
  options.want_polygons = true;
  const auto result = client::BodyClient::Connect(server.address())
                          .ApproximateMesh(Moved(Mannequin(), to_centimetres), options);
  ASSERT_TRUE(result.ok()) << result.status();
  const std::string text = client::FormatResult(*result, "arrays");
  EXPECT_NE(text.find("\"unit\": \"centimetre\""), std::string::npos);
  EXPECT_NE(text.find("\"up_axis\": \"z\""), std::string::npos);
  const std::string path = scratch.Path("arrays.json");
  WriteText(path, text);
  Check({path});
}

}  // namespace
}  // namespace capfit::e2e
