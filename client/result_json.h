// RESULT.json, the file that every other tool reads. Its shape is kept for good:
//
//   {"spheres": [[x, y, z, r], ...], "capsules": [[i, j], ...], "sphere_parts": ["torso", ...],
//    "landmarks": {"left_wrist": [x, y, z], ...},
//    "warnings": [{"code": "HOLES_CLOSED", "message": "...", "count": 2}, ...],
//    "metrics": {"n_p": .., "E_r": .., "outside": .., "uncovered": .., "E_M": .., "max_gap": ..,
//                "gap": {"mean": .., "p95": .., "max": ..}, ..., "parts": {"torso": {...}, ...}},
//    "stages": {"mesh": seconds, ...}, "seconds": total without reading the file}
//
// All coordinates, radii, lengths (max_gap, max_out and gap too) and the parts' volumes are in the
// unit and axes of the mesh file; E_M and hausdorff in percent; the rest of the metrics are shares
// and counts. Those of a part are "spheres", "capsules", "volume", "E_r", "outside", "uncovered",
// "E_M", "volume_ratio", "gap", "surface_out", "vertices_out" and "max_out"; what they mean, and by
// which rule volumes are shared out among the parts: metrics::Metrics and metrics::Volumes. Where
// feature polygons were asked for there is also
//   "polygons": [{"name": "hip", "part": "torso", "outline": [[x, y, z], ...],
//                 "circles": [[x, y, z, r], ...], "outside_area_ratio": ..}, ...].
// Later versions may add members; readers ignore those that they do not know.
#ifndef CAPFIT_CLIENT_RESULT_JSON_H_
#define CAPFIT_CLIENT_RESULT_JSON_H_

#include <string>

#include "core/pipeline/fit.h"

namespace capfit::client {

// The file's text, ending with a newline. Doubles are written with as many digits as bring back the
// same bits.
[[nodiscard]] std::string FormatResult(const pipeline::FitResult& result);

// The object "metrics" alone, a line for each part, no newline at the end.
[[nodiscard]] std::string FormatMetrics(const metrics::Metrics& metrics, double metres_per_unit);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_RESULT_JSON_H_
