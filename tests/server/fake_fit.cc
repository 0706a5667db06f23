#include "tests/server/fake_fit.h"

#include <chrono>
#include <limits>
#include <thread>

#include "core/base/enum_index.h"

namespace capfit::server {
namespace {

absl::Status AcceptAll(const pipeline::FitOptions&) { return absl::OkStatus(); }

skinning::DenseWeights NumberedWeights(std::size_t spheres, std::size_t vertices) {
  skinning::DenseWeights weights{spheres, vertices, {}};
  for (std::size_t i = 0; i < spheres * vertices; ++i) {
    weights.weights.push_back(static_cast<float>(i) + 0.25F);
  }
  return weights;
}

metrics::Metrics HandMadeMetrics() {
  metrics::Metrics metrics;
  metrics.n_p = 5;
  metrics.spheres = 3;
  metrics.capsules = 2;
  metrics.E_r = 0.5;
  metrics.outside = 0.4;
  metrics.uncovered = 0.1;
  metrics.E_M = 1.5;
  metrics.hausdorff = 6.5;
  metrics.max_gap_m = 0.002;
  metrics.volume_ratio = 1.3;
  metrics.iou = 0.643;
  metrics.mirror_error = 0.01;
  metrics.gap = {0.03, 0.07, 0.13};
  metrics.surface_out = 0.021;
  metrics.vertices_out = 3;
  metrics.max_out_m = 0.0004;
  metrics.parts[Index(body::Part::kTorso)] = {
      1, 0, 0.0375, 0.46, 0.37, 0.09, 1.1, 1.28, {0.022, 0.05, 0.11}, 0.014, 1, 0.0003};
  metrics.parts[Index(body::Part::kLeftArm)] = {
      1, 1, 0.0043, 0.61, 0.48, 0.13, 1.9, 1.35, {0.038, 0.09, 0.13}, 0.053, 2, 0.0004};
  return metrics;
}

}  // namespace

pipeline::FitResult HandMadeResult(std::size_t vertex_count) {
  pipeline::FitResult result;
  result.primitives.spheres = {{{0.1, 1.0 / 3.0, -2.5}, 0.125}, {{1, 2, 3}, 0.5}, {{4, 5, 6}, 0.7}};
  result.primitives.origins = {
      {body::Part::kTorso, 4, 0}, {body::Part::kLeftArm, 7, 2}, {body::Part::kRightArm, -1, 1}};
  result.primitives.capsules = {{0, 1}, {0, 2}};
  result.sphere_names = {"chest_1", "left_upper_arm_1", "right_upper_arm_1"};
  result.landmarks = {{"neck", {0.0, 1.4, 0.1}, body::LandmarkMethod::kMeasured, 0.75},
                      {"left_wrist", {0.5, 1.0, 0.2}, body::LandmarkMethod::kCaller, 1.0}};
  result.polygons = {
      {"hip", body::Part::kTorso, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{{0.2, 0, 0.2}, 0.3}}, 0.17}};
  result.metrics = HandMadeMetrics();
  if (vertex_count > 0) {
    result.weights = NumberedWeights(3, vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      result.vertex_gaps.push_back(static_cast<float>(v) * 0.125F - 0.5F);
    }
    result.vertex_gaps[vertex_count / 2] = std::numeric_limits<float>::quiet_NaN();
  }
  result.warnings = {{"HOLES_CLOSED", "2 holes were closed", 2}};
  result.effective_options.max_spheres = 32;
  result.effective_options.max_capsules = 31;
  result.effective_options.quality = pipeline::Quality::kTight;
  result.effective_options.engine = "unity_cloth";
  result.effective_options.parts.head = true;
  result.effective_options.require_parts.legs = true;
  result.effective_options.sex = section::Sex::kFemale;
  result.effective_options.unit = body::Unit::kCentimetre;
  result.effective_options.up = body::UpAxis::kZ;
  result.effective_options.seed = 7;
  result.effective_options.tolerance_m = 0.002;
  result.effective_options.want_polygons = true;
  result.effective_options.want_vertex_gaps = vertex_count > 0;
  result.body = {1234, 2345, {-50, -20, 0}, {50, 20, 170}, 1.7, true, {}};
  result.version = "1.2.3";
  result.body_from_caller.scale = 0.01;
  result.body_from_caller.translation = {1, 2, 3};
  result.stage_seconds = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.0, 0.8, 0.9};
  result.seconds = 3.8;
  return result;
}

FitBackend InstantBackend(std::size_t vertex_count) {
  return {
      AcceptAll,
      [vertex_count](const formats::PolygonSoup&, const pipeline::FitOptions&, const ThreadPool&,
                     FitObserver& observer) -> absl::StatusOr<pipeline::FitResult> {
        for (int i = 0; i < kStageCount; ++i) {
          observer.OnStage(static_cast<Stage>(i), i / static_cast<double>(kStageCount));
        }
        return HandMadeResult(vertex_count);
      }};
}

FitBackend WaitingBackend(Gate& gate) {
  return {AcceptAll,
          [&gate](const formats::PolygonSoup&, const pipeline::FitOptions&, const ThreadPool&,
                  FitObserver& observer) -> absl::StatusOr<pipeline::FitResult> {
            observer.OnStage(Stage::kCircle, 0.5);
            ++gate.waiting;
            while (!gate.open && !observer.IsCancelled()) {
              std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            --gate.waiting;
            if (observer.IsCancelled()) return absl::CancelledError("the observer said so");
            return HandMadeResult();
          }};
}

}  // namespace capfit::server
