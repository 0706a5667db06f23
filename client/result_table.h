// A result as a table for people.
#ifndef CAPFIT_CLIENT_RESULT_TABLE_H_
#define CAPFIT_CLIENT_RESULT_TABLE_H_

#include <string>

#include "core/metrics/measure.h"
#include "core/pipeline/fit.h"

namespace capfit::client {

// The parts, then the metrics of the whole, then the time of each stage: aligned columns, with
// units, at most 100 of them for any fit that makes sense, ending with a newline. (Warnings are for
// standard error: exit_code.h.)
[[nodiscard]] std::string ResultTable(const pipeline::FitResult& result);

// The metrics of the whole alone.
[[nodiscard]] std::string MetricsTable(const metrics::Metrics& metrics);

// A line for each part and one for the whole: primitives, volumes, gaps, coverage.
[[nodiscard]] std::string PartsTable(const metrics::Metrics& metrics);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_RESULT_TABLE_H_
