// The whole fit: options and their limits, the result, and the order of the rooms (paper, Fig. 1).
#ifndef CAPFIT_CORE_PIPELINE_FIT_H_
#define CAPFIT_CORE_PIPELINE_FIT_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/body/find_body.h"
#include "core/capsule/primitive_set.h"
#include "core/character/find_character.h"
#include "core/export/export.h"
#include "core/formats/polygon_soup.h"
#include "core/metrics/measure.h"
#include "core/motion/cover_motion.h"
#include "core/pipeline/motion_frames.h"
#include "core/refine/layouts/kept_layout.h"
#include "core/section/feature_polygon.h"
#include "core/skinning/bone_weights.h"
#include "core/skinning/mean_value_coordinates.h"
#include "core/skinning/sparse_weights.h"

namespace capfit::pipeline {

// Limits of the options, both ends allowed. The lowest counts are what five chains of two spheres
// and one capsule each need.
struct CountRange {
  int low = 0;
  int high = 0;
};
inline constexpr CountRange kMaxPrimitivesRange{15, 1000};
inline constexpr CountRange kMaxSpheresRange{10, 500};
inline constexpr CountRange kMaxCapsulesRange{5, 1000};
inline constexpr double kMinPolygonError = 0.001;
inline constexpr double kMaxPolygonError = 2.0;
inline constexpr int kDefaultMaxPrimitives = 64;
inline constexpr double kMaxToleranceM = 0.1;
inline constexpr std::size_t kMostPartNames = 64;     // in each of the two lists
inline constexpr std::size_t kLongestPartName = 256;  // bytes
inline constexpr std::size_t kMostPartsTold = 1000;

// kEnclose: nothing of the fitted parts is left outside (but for tolerance_m). kBestFit: the
// smallest E_r.
enum class FitMode { kEnclose, kBestFit };
// kPaper: the published method, its coverage step replaced by a better one. The others, under the
// same budget: centres, radii and topology found together (core/refine); kBalanced with a half to a
// sixth of the search of kTight.
enum class Quality { kPaper, kBalanced, kTight };
inline constexpr int kQualityCount = 3;
// "paper", "balanced", "tight".
[[nodiscard]] std::string_view QualityName(Quality quality);
// What carries the centres along: a weight of every vertex; of few vertices; of the skeleton's
// joints.
enum class SkinningMode { kNone, kDense, kSparse, kBones };

// A format of exports::ExportFormats().
struct ExportWish {
  std::string format;
  exports::ExportOptions options;
};

// A file of an export, and the format it belongs to.
struct ExportedFile {
  std::string format;
  exports::ExportFile file;
};

// How much may be spent. At most one of the three ways: max_primitives; max_spheres and/or
// max_capsules; polygon_error. None of them: max_primitives 64.
struct FitOptions {
  std::optional<int> max_primitives;    // n_p = spheres + cones
  std::optional<int> max_spheres;       // beside max_capsules, or alone
  std::optional<int> max_capsules;      // beside max_spheres, or alone
  std::optional<double> polygon_error;  // outside area / polygon area
  FitMode fit = FitMode::kEnclose;
  Quality quality = Quality::kPaper;
  // Covers by growing alone, the published method's own last step (III-D), instead of tightening:
  // about twice the E_r. For comparisons with quality kPaper; the service does not offer it.
  bool grows_only = false;
  // A name of Engines(), or empty. Its limits hold beside the budget (without one, they are the
  // budget), and coverage holds for what the engine makes of a capsule.
  std::string engine;
  // A layout to keep in place of a budget: the same spheres by the same names and numbers, tied by
  // the same capsules. `quality` says nothing then: the search for a topology is left out. Engines
  // with capsules of one radius, whose capsules share no spheres, cannot have one.
  std::optional<refine::KeptLayout> layout = {};
  // Poses that are to be enclosed as well, with the centres carried by sparse weights; see
  // core/motion. With kEnclose only, and not for engines whose capsules are no tangent hulls.
  std::shared_ptr<const Motion> motion = nullptr;
  double tolerance_m = 0.0;  // how far a vertex may stick out when enclosing; [0, kMaxToleranceM]
  SkinningMode skinning = SkinningMode::kNone;
  body::PartSelection parts;
  // Parts that must be on the body, none unless asked for; else FAILED_PRECONDITION naming those
  // that are not. (Without it a missing part is a warning and what is there is fitted.)
  body::PartSelection require_parts = {false, false, false, false, false, false};
  section::Sex sex = section::Sex::kAuto;
  body::Unit unit = body::Unit::kAuto;
  body::UpAxis up = body::UpAxis::kAuto;
  std::map<body::LandmarkId, Eigen::Vector3d> landmarks;  // the caller's, in the caller's frame
  character::CharacterOptions character;                  // which parts of the file are the body
  std::uint64_t seed = 0;
  bool want_polygons = false;     // return the feature polygons with their circles
  bool want_vertex_gaps = false;  // return each vertex's signed distance to the set
  // Files for engines. Fit makes none: they may need the mesh's own file; see AddExports.
  std::vector<ExportWish> exports = {};
};

// OK, or INVALID_ARGUMENT naming the option, its value and its range; UNIMPLEMENTED for what this
// version does not do.
[[nodiscard]] absl::Status ValidateOptions(const FitOptions& options);

// One feature polygon with its circles, in the caller's frame.
struct PolygonResult {
  std::string name;
  body::Part part = body::Part::kTorso;
  std::vector<Eigen::Vector3d> outline;
  std::vector<geometry::Sphere> circles;  // centre and radius; they lie in the outline's plane
  double outside_area_ratio = 0.0;        // circle outside area / polygon area
};

struct LandmarkResult {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  body::LandmarkMethod method = body::LandmarkMethod::kMeasured;
  double confidence = 1.0;
};

// The mesh that was fitted, as it came, so that a result can be told from that of another body.
struct BodyFacts {
  std::int64_t vertex_count = 0;                      // of the caller's mesh
  std::int64_t face_count = 0;                        // of the caller's mesh
  Eigen::Vector3d box_min = Eigen::Vector3d::Zero();  // of the vertices that were fitted, in the
  Eigen::Vector3d box_max = Eigen::Vector3d::Zero();  // caller's unit and axes
  double height_m = 0.0;                              // along the body's own up axis
  bool is_symmetric = false;                          // as body::Body
  // What became of the parts of a file of several, at most kMostPartsTold; empty where the mesh was
  // one surface.
  std::vector<character::CharacterPart> parts;
};

// Everything in the caller's unit and axes, but for metrics in metres where the name says so.
struct FitResult {
  capsule::PrimitiveSet primitives;
  // For each sphere: unique, the same for the sphere on the other side but for left and right; see
  // sphere_names.h.
  std::vector<std::string> sphere_names;
  // For each sphere where on the body it is, in measures that hold for any body: with the names,
  // the origins and the capsules a layout to keep. Nothing where the body lacks the landmarks.
  std::vector<std::optional<refine::BodyPlace>> sphere_places;
  std::vector<LandmarkResult> landmarks;
  std::vector<PolygonResult> polygons;  // where asked for
  metrics::Metrics metrics;
  // Where asked for, one of the three.
  std::optional<skinning::DenseWeights> weights;
  std::optional<skinning::SparseWeights> sparse_weights;
  std::optional<skinning::BoneWeights> bone_weights;
  // The skeleton that came with the mesh, in the mesh's frame; empty where none did.
  std::vector<formats::NamedJoint> joints;
  // The joint that carries each sphere, and each capsule, best, for engines that hang each on one:
  // indices into `joints`. Empty without a skeleton that holds vertices.
  std::vector<std::int32_t> sphere_joints;
  std::vector<std::int32_t> capsule_joints;
  // How far that one joint misleads each sphere, in metres: see skinning::OneJoint.
  std::vector<double> sphere_joint_drift_m;
  // Where asked for: for each of the caller's vertices the signed distance to the boundary of the
  // set's union, in the caller's unit: > 0 outside of the set, < 0 where the set covers it. NaN for
  // vertices of parts that were not selected, and for those of which mending left nothing (no face
  // uses them). Welded copies have the same value.
  std::vector<float> vertex_gaps;
  std::vector<ExportedFile> exports;  // see AddExports
  std::vector<Warning> warnings;
  geometry::Similarity body_from_caller;  // scale: metres per caller's unit
  // What held in the end: the options with their defaults filled in and the engine's limits
  // applied, `unit` and `up` as told or found (kAuto where no positive axis is within 15 degrees of
  // up).
  FitOptions effective_options;
  BodyFacts body;
  std::optional<motion::MotionReport> motion;  // where poses were given
  std::string version;                         // of the program that fitted, e.g. "0.1.0"
  std::array<double, kStageCount> stage_seconds{};
  double seconds = 0.0;  // of the whole fit, reading the file not included
};

// The layout of a result, for FitOptions::layout.
[[nodiscard]] refine::KeptLayout LayoutOf(const FitResult& result);

// Fits one body. Errors: INVALID_ARGUMENT (mesh or option, field named), FAILED_PRECONDITION (not a
// body, part missing), UNIMPLEMENTED, CANCELLED (the observer said so). Same soup and options, same
// bits, for any pool.
[[nodiscard]] absl::StatusOr<FitResult> Fit(const formats::PolygonSoup& soup,
                                            const FitOptions& options, const ThreadPool& pool,
                                            FitObserver& observer);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_FIT_H_
