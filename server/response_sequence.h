// A result as the messages of the answer, made one at a time as the reader takes them.
#ifndef CAPFIT_SERVER_RESPONSE_SEQUENCE_H_
#define CAPFIT_SERVER_RESPONSE_SEQUENCE_H_

#include <cstddef>
#include <string>

#include "capfit/v1/service.pb.h"
#include "core/pipeline/fit.h"

namespace capfit::server {

// Weights or gaps in one message: 192 Ki floats are 768 KiB, well below the 1 MiB that is promised.
inline constexpr std::size_t kMaxWeightsPerMessage = 192 * 1024;

// Yields warnings, landmarks, feature polygons, primitives, weights, vertex gaps, exported files
// and the summary, in this order. Holds the result and one message at most, so a slow reader costs
// no more than that.
class ResponseSequence {
 public:
  ResponseSequence(pipeline::FitResult result, std::string request_id,
                   std::size_t max_weights_per_message = kMaxWeightsPerMessage)
      : result_(std::move(result)),
        request_id_(std::move(request_id)),
        max_weights_(max_weights_per_message) {}

  // Overwrites `response` with the next message; false behind the last.
  [[nodiscard]] bool Next(v1::ApproximateBodyResponse& response);

 private:
  enum class Section {
    kWarnings,
    kLandmarks,
    kPolygons,
    kPrimitives,
    kWeights,
    kVertexGaps,
    kExports,
    kSummary,
    kEnd
  };

  // Fills `response` from the section that is on; false when that section has no more.
  [[nodiscard]] bool Fill(v1::ApproximateBodyResponse& response);
  [[nodiscard]] bool FillWeights(v1::ApproximateBodyResponse& response);
  [[nodiscard]] bool FillGaps(v1::ApproximateBodyResponse& response);
  [[nodiscard]] bool FillExports(v1::ApproximateBodyResponse& response);

  pipeline::FitResult result_;
  std::string request_id_;
  std::size_t max_weights_;
  Section section_ = Section::kWarnings;
  // Within the section; of the sphere for weights, of the vertex for gaps.
  std::size_t index_ = 0;
  std::size_t first_vertex_ = 0;  // weights only
  std::size_t first_byte_ = 0;    // exports only
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_RESPONSE_SEQUENCE_H_
