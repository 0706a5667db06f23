// The bodies with known joints that the landmark report measures.
#ifndef CAPFIT_TESTS_BENCH_LANDMARK_SAMPLES_H_
#define CAPFIT_TESTS_BENCH_LANDMARK_SAMPLES_H_

#include <functional>
#include <string>

#include "tests/bench/pose_body.h"

namespace capfit::body {

struct Sample {
  std::string group;  // "posed", "density", "animation", "unseen"
  std::string name;
  std::string pose;  // of the unseen ones
  TrueBody truth;
};

// Calls `measure` for each: the posed bodies of the folder, one body from 5k to 200k faces and
// remeshed, every sixth frame of the animation, and all bodies at rest in the unseen poses.
void ForEachSample(const std::function<void(const Sample&)>& measure);

}  // namespace capfit::body

#endif  // CAPFIT_TESTS_BENCH_LANDMARK_SAMPLES_H_
