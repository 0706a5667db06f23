// What the server calls to do the work: the pipeline, or a stand-in in tests.
#ifndef CAPFIT_SERVER_FIT_BACKEND_H_
#define CAPFIT_SERVER_FIT_BACKEND_H_

#include <functional>

#include "core/pipeline/fit.h"

namespace capfit::server {

// Signatures and promises as pipeline::ValidateOptions and pipeline::Fit. Called from several
// threads at once.
struct FitBackend {
  std::function<absl::Status(const pipeline::FitOptions&)> validate;
  std::function<absl::StatusOr<pipeline::FitResult>(
      const formats::PolygonSoup&, const pipeline::FitOptions&, const ThreadPool&, FitObserver&)>
      fit;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FIT_BACKEND_H_
