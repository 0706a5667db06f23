// What a picture says of a result in words and colours.
#ifndef CAPFIT_CLIENT_PICTURE_RESULT_WORDS_H_
#define CAPFIT_CLIENT_PICTURE_RESULT_WORDS_H_

#include <array>
#include <string>
#include <vector>

#include "client/picture/legend.h"
#include "client/picture/result_set.h"
#include "core/body/anatomy.h"
#include "core/body/body.h"

namespace capfit::client {

// For each body::Part.
using PartFlags = std::array<bool, body::kPartCount>;

// The parts that the primitives stand for: those that were fitted, or, of another program's result,
// those that a sphere names. All where it does not say.
[[nodiscard]] PartFlags FittedParts(const ResultSet& result);

// The parts that have a vertex.
[[nodiscard]] PartFlags PartsOnBody(const body::Body& body);

// "n_p 64     27 spheres + 37 capsules     E_r 0.252     E_M 0.54 %     quality tight     engine
// physx": what the result tells.
[[nodiscard]] std::string Caption(const ResultSet& result);

// "not fitted: head, left hand, feet     not on the body: right hand" for parts that are on the
// body, or were asked for and are not; "" where nothing is missing. A pair goes by one word.
[[nodiscard]] std::string MissingParts(const ResultSet& result, const PartFlags& on_body);

// The colours of the parts that have primitives.
[[nodiscard]] std::vector<LegendEntry> PartLegend(const ResultSet& result);

// The parts of the feature polygons, and the lines of the drawing.
[[nodiscard]] std::vector<LegendEntry> PolygonLegend(const ResultSet& result);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_RESULT_WORDS_H_
