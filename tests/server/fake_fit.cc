#include "tests/server/fake_fit.h"

#include <chrono>
#include <thread>

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

}  // namespace

pipeline::FitResult HandMadeResult(std::size_t vertex_count) {
  pipeline::FitResult result;
  result.primitives.spheres = {{{0.1, 1.0 / 3.0, -2.5}, 0.125}, {{1, 2, 3}, 0.5}, {{4, 5, 6}, 0.7}};
  result.primitives.origins = {
      {body::Part::kTorso, 4, 0}, {body::Part::kLeftArm, 7, 2}, {body::Part::kRightArm, -1, 1}};
  result.primitives.capsules = {{0, 1}, {0, 2}};
  result.landmarks = {{"neck", {0.0, 1.4, 0.1}, body::LandmarkMethod::kMeasured, 0.75},
                      {"left_wrist", {0.5, 1.0, 0.2}, body::LandmarkMethod::kCaller, 1.0}};
  result.polygons = {
      {"hip", body::Part::kTorso, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{{0.2, 0, 0.2}, 0.3}}, 0.17}};
  result.metrics = {5, 0.5, 0.4, 0.1, 1.5, 6.5, 0.002, 1.3, 0.01, 3, 0.0004};
  if (vertex_count > 0) result.weights = NumberedWeights(3, vertex_count);
  result.warnings = {{"HOLES_CLOSED", "2 holes were closed", 2}};
  result.body_from_caller.scale = 0.01;
  result.body_from_caller.translation = {1, 2, 3};
  result.stage_seconds = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.0, 0.8, 0.9};
  result.seconds = 3.8;
  return result;
}

FitBackend InstantBackend(std::size_t vertex_count) {
  return {AcceptAll,
          [vertex_count](const mesh::PolygonSoup&, const pipeline::FitOptions&, const ThreadPool&,
                         FitObserver& observer) -> absl::StatusOr<pipeline::FitResult> {
            for (int i = 0; i < kStageCount; ++i) {
              observer.OnStage(static_cast<Stage>(i), i / static_cast<double>(kStageCount));
            }
            return HandMadeResult(vertex_count);
          }};
}

FitBackend WaitingBackend(Gate& gate) {
  return {AcceptAll,
          [&gate](const mesh::PolygonSoup&, const pipeline::FitOptions&, const ThreadPool&,
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
