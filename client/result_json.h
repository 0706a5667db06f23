// RESULT.json, the file that every other tool reads. docs/result.schema.json is its JSON Schema:
// every member with its unit, and which of them are always there. In short, version 1:
//
//   {"format": "capfit-result", "format_version": 1, "version": "0.1.0",
//    "unit": "centimetre", "metres_per_unit": 0.01, "up_axis": "y", "request_id": "...",
//    "body_from_caller": {"rotation": [9], "scale": .., "translation": [3]},
//    "body": {"vertex_count": .., "box_min": [3], ...}, "options": {"budget": {...}, ...},
//    "spheres": [[x, y, z, r], ...], "capsules": [[i, j], ...],
//    "sphere_names": [...], "sphere_parts": [...], "sphere_mirrors": [...],
//    "sphere_places": [{"bone": "upper_arm", "is_right": false, "along": .., ...}, ...],
//    "sphere_polygons": [...], "capsule_parts": [...],
//    "joints": [{"name": .., "parent": .., "to_mesh": [12], ...}, ...], "sphere_joints": [...],
//    "sphere_joint_drift_m": [...], "capsule_joints": [...],
//    "sparse_weights": {"vertex_count": .., "rows": [{"vertices": [...], "weights": [...]}, ...]},
//    "bone_weights": {"rows": [{"joints": [...], "weights": [...], "offsets": [[3], ...]}, ...]},
//    "landmarks": {"left_wrist": {"position": [3], "method": "measured", "confidence": 0.9}, ...},
//    "warnings": [{"code": .., "message": .., "count": ..}, ...],
//    "metrics": {"primitive_count": .., "volume_error": .., ..., "parts": {"torso": {...}, ...}},
//    "stages": {"mesh": seconds, ...}, "seconds": total without reading the file,
//    "feature_polygons": [{"name": .., "part": .., "outline": [[3], ...],
//                          "circles": [[x, y, z, r], ...], "outside_area_ratio": ..}, ...]}
//
// Points, radii and boxes are in the unit and axes of the mesh file, which "unit" and "up_axis"
// tell; a length in metres says so in its name (max_gap_m). Names and words are those of the
// contract (proto/capfit/v1), words in small letters without their enum's prefix. Later versions
// may add members; readers ignore those that they do not know.
#ifndef CAPFIT_CLIENT_RESULT_JSON_H_
#define CAPFIT_CLIENT_RESULT_JSON_H_

#include <string>

#include "core/pipeline/fit.h"

namespace capfit::client {

// Of the file's shape: it grows when a member changes its meaning or goes away.
inline constexpr int kResultFormatVersion = 1;

// The file's text, ending with a newline. Doubles are written with as many digits as bring back the
// same bits. No request id, no member.
[[nodiscard]] std::string FormatResult(const pipeline::FitResult& result,
                                       const std::string& request_id = "");

// The object "metrics" alone, no newline at the end.
[[nodiscard]] std::string FormatMetrics(const metrics::Metrics& metrics);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_RESULT_JSON_H_
