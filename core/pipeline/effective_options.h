// What held in the end, for the result to tell.
#ifndef CAPFIT_CORE_PIPELINE_EFFECTIVE_OPTIONS_H_
#define CAPFIT_CORE_PIPELINE_EFFECTIVE_OPTIONS_H_

#include "core/body/body.h"
#include "core/formats/polygon_soup.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {

// FitResult::effective_options for the options as asked.
[[nodiscard]] FitOptions EffectiveOptions(const FitOptions& asked,
                                          const geometry::Similarity& body_from_caller);

// FitResult::body but for its box.
[[nodiscard]] BodyFacts FactsOf(const formats::PolygonSoup& soup, const body::Body& body);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_EFFECTIVE_OPTIONS_H_
