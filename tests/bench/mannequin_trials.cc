// Random battered mannequins through mesh preparation, landmarks and the whole fit.
//
//   mannequin_trials [COUNT] [FIRST_SEED]     prints each failure; fails below 99 %
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/mesh/prepare_mesh.h"
#include "core/pipeline/fit.h"
#include "tests/core/body/mannequin_trial.h"

namespace capfit {
namespace {

std::vector<std::string> RunTrial(const body::MannequinTrial& trial, const ThreadPool& pool) {
  const auto prepared = mesh::PrepareMesh(trial.battered);
  if (!prepared.ok()) return {prepared.status().ToString()};
  NullObserver observer;
  const auto body = body::FindBody(prepared->mesh, {}, pool, observer);
  if (!body.ok()) return {body.status().ToString()};
  std::vector<std::string> faults = body::FaultsOf(*body, trial);
  const auto fit = pipeline::Fit(trial.battered, {}, pool, observer);
  if (!fit.ok()) faults.push_back(fit.status().ToString());
  return faults;
}

int Main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 300;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  const ThreadPool pool(1);
  int good = 0;
  for (int i = 0; i < count; ++i) {
    const body::MannequinTrial trial =
        body::MakeMannequinTrial(static_cast<std::uint64_t>(first + i));
    const std::vector<std::string> faults = RunTrial(trial, pool);
    good += faults.empty() ? 1 : 0;
    if (faults.empty()) continue;
    std::printf("%d: %s\n", first + i, trial.Description().c_str());
    for (const std::string& fault : faults) std::printf("    %s\n", fault.c_str());
    std::fflush(stdout);
  }
  std::printf("%d of %d fitted with every landmark in its part\n", good, count);
  return 100 * good >= 99 * count ? 0 : 1;
}

}  // namespace
}  // namespace capfit

int main(int argc, char** argv) { return capfit::Main(argc, argv); }
