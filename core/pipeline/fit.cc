#include "core/pipeline/fit.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/backlog.h"
#include "core/base/status.h"
#include "core/base/version.h"
#include "core/circle/error_curve.h"
#include "core/coverage/cover_body.h"
#include "core/pipeline/bind_spheres.h"
#include "core/pipeline/cover_poses.h"
#include "core/pipeline/effective_options.h"
#include "core/pipeline/engines.h"
#include "core/pipeline/fit_steps.h"
#include "core/pipeline/overlap_warning.h"
#include "core/pipeline/plan.h"
#include "core/pipeline/primitive_stage.h"
#include "core/pipeline/sphere_names.h"
#include "core/pipeline/stage_clock.h"
#include "core/pipeline/take_body.h"
#include "core/pipeline/to_caller_frame.h"
#include "core/refine/refine.h"

namespace capfit::pipeline {
namespace {

// Whether joints hold vertices of the mesh.
absl::Status NoRig() {
  return InvalidField(ErrorReason::kConflict, "options.skinning",
                      "is for bones, but the mesh has no skeleton that holds its vertices; ask for "
                      "sparse weights, or send a GLB or VRM file with a skin");
}

std::vector<std::string> NamesOf(const refine::KeptLayout& layout) {
  std::vector<std::string> names;
  names.reserve(layout.spheres.size());
  for (const refine::KeptSphere& sphere : layout.spheres) names.push_back(sphere.name);
  return names;
}

// A set that covering may be what is smallest of.
struct FoundSet {
  capsule::PrimitiveSet set;
  bool has_shape = false;  // see CoverOptionsFor
};

// The rooms behind the mesh, in their order.
class BodyFit {
 public:
  BodyFit(const FitOptions& options, const ThreadPool& pool, StageClock& clock, FitResult& result)
      : asked_(options),
        options_(WithEngineLimits(options)),
        pool_(pool),
        clock_(clock),
        backlog_(pool, clock),
        result_(result) {}

  absl::Status Run(const formats::PolygonSoup& soup) {
    if (asked_.skinning == SkinningMode::kBones && !HasRig(soup)) return NoRig();
    if (options_.motion != nullptr) {
      CAPFIT_RETURN_IF_ERROR(CheckMotion(*options_.motion, soup));
      if (asked_.skinning == SkinningMode::kBones && options_.motion->joints.empty()) {
        return InvalidField(ErrorReason::kConflict, "motion",
                            "is of vertices alone, and bones carry the centres: name a clip of the "
                            "mesh's file, or ask for sparse weights");
      }
    }
    will_move_ = options_.motion != nullptr || HasRig(soup);
    CAPFIT_RETURN_IF_ERROR(Understand(soup));
    CAPFIT_RETURN_IF_ERROR(Build());
    LayGroundForLater();
    CAPFIT_RETURN_IF_ERROR(Cover());
    if (options_.motion != nullptr) CAPFIT_RETURN_IF_ERROR(CoverMotion(soup));
    CAPFIT_RETURN_IF_ERROR(Measure());
    CAPFIT_RETURN_IF_ERROR(Bind(soup));
    return absl::OkStatus();
  }

 private:
  absl::Status Understand(const formats::PolygonSoup& soup) {
    CAPFIT_ASSIGN_OR_RETURN(TakenBody taken,
                            TakeBody(soup, options_, pool_, clock_, result_.warnings));
    body_ = std::move(taken.body);
    result_.body_from_caller = body_->body_from_caller;
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(clock_));
    caller_from_body_ = body_->body_from_caller.Inverse();
    target_ = tighten::TargetOf(*body_, options_.parts, pool_);
    result_.effective_options = EffectiveOptions(asked_, body_->body_from_caller);
    result_.body = FactsOf(soup, *body_);
    result_.body.parts = std::move(taken.parts);
    if (result_.body.parts.size() > kMostPartsTold) result_.body.parts.resize(kMostPartsTold);
    result_.body.box_min = taken.box_min;
    result_.body.box_max = taken.box_max;
    result_.landmarks = LandmarkResults(*body_, caller_from_body_);
    return CheckCancelled(clock_);
  }

  // What covering takes from the body alone is made beside the first step of Build that does not
  // keep all threads busy all the time.
  template <typename Work>
  void BesideCoverGround(const Work& work) {
    if (std::exchange(has_cover_ground_, true)) return work();
    // Before Build changes the options.
    const int primitives =
        options_.polygon_error ? kUsualPrimitives : TotalBudget(options_).UsualPrimitives();
    Backlog ground(pool_, clock_);
    ground.Add(1, [this, primitives](std::size_t) { LayCoverGround(primitives); });
    ground.Beside(work);
    ground.Finish();
  }

  void LayCoverGround(int primitives) {
    if (options_.fit != FitMode::kEnclose || target_.points_m.empty()) return;
    cover_ground_ =
        coverage::MakeCoverGround(target_, body_->is_symmetric,
                                  CoverOptionsFor(options_, HasShape(options_)), primitives, pool_);
  }

  // What naming and measuring take from the body alone, left to whoever has time while the set is
  // covered.
  void LayGroundForLater() {
    backlog_.Add(1, [this](std::size_t) { skeleton_.emplace(*body_); });
    measure_ground_.emplace(*body_, ToMeasure(), CoversLast(options_, *body_), backlog_);
  }

  // Capsules that share no spheres cost more than the budget of capsules tells, where there are
  // spheres without a capsule beside them: then again with fewer.
  absl::Status Build() {
    if (options_.layout) return KeepLayout();
    const std::size_t warnings = result_.warnings.size();
    for (;;) {
      result_.warnings.resize(warnings);
      found_.clear();
      CAPFIT_RETURN_IF_ERROR(CheckBudget(*body_, asked_, options_));
      if (NeedsPolygons(options_)) CAPFIT_RETURN_IF_ERROR(Approximate());
      if (IsSearched(options_)) CAPFIT_RETURN_IF_ERROR(Refine());
      CAPFIT_RETURN_IF_ERROR(CheckFound());
      if (ProfileOf(options_) == capsule::CapsuleProfile::kUniformRadius) {
        for (FoundSet& found : found_) found.set = capsule::WithUniformRadii(found.set);
      }
      const capsule::PrimitiveSet& first = found_.front().set;
      const int excess = ExcessCapsules(asked_, first);
      if (excess <= 0) break;
      options_.max_capsules = static_cast<int>(first.capsules.size()) - excess;
    }
    std::erase_if(found_, [this](const FoundSet& found) {
      return found.set.spheres.empty() || ExcessCapsules(asked_, found.set) > 0;
    });
    return absl::OkStatus();
  }

  // The topology is given.
  absl::Status KeepLayout() {
    if (options_.want_polygons) CAPFIT_RETURN_IF_ERROR(Approximate());
    clock_.Begin(Stage::kRefine);
    absl::StatusOr<capsule::PrimitiveSet> kept;
    BesideCoverGround([&] {
      kept = refine::FitToLayout(*body_, target_, *options_.layout,
                                 RefineOptionsFor(options_, {}, will_move_), pool_, clock_);
    });
    CAPFIT_ASSIGN_OR_RETURN(capsule::PrimitiveSet set, std::move(kept));
    found_.assign(1, {std::move(set), /*has_shape=*/true});
    return CheckCancelled(clock_);
  }

  absl::Status Approximate() {
    clock_.Begin(Stage::kSection);
    const capsule::Budget total = TotalBudget(options_);
    const capsule::Budget chains = ChainBudget(total, OverheadOf(*body_, options_, total));
    section::FeaturePolygons features = section::ExtractFeaturePolygons(
        *body_, PlanSections(options_, *body_, chains), pool_, clock_);
    Append(std::move(features.warnings), result_.warnings);
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(clock_));

    clock_.Begin(Stage::kCircle);
    circle::CircleOptions circle_options;
    circle_options.seed = options_.seed;
    const circle::ErrorCurves drafts(features.polygons, kMaxCirclesPerPolygon,
                                     circle::DraftOptions(circle_options), pool_, clock_);
    std::optional<circle::ErrorCurves> best;
    if (!DraftsServe(options_)) {
      best.emplace(features.polygons, kMaxCirclesPerPolygon, circle_options, pool_, clock_);
    }
    const circle::ErrorCurves& curves = best ? *best : drafts;
    (options_.polygon_error ? curves : drafts).Prepare(kCirclesFittedAhead);
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(clock_));

    clock_.Begin(Stage::kCapsule);
    PrimitiveStage stage;
    BesideCoverGround([&] {
      stage = BuildUnderBudget(*body_, options_, features.polygons, drafts, curves, pool_);
    });
    if (options_.polygon_error) {
      auto warning =
          WarningOfPolygonError(*options_.polygon_error, features.polygons, stage.approximations);
      if (warning) result_.warnings.push_back(*std::move(warning));
    }
    capsule::PrimitiveSet set = std::move(stage.set);
    if (!IsSearched(options_) && options_.fit == FitMode::kBestFit && !options_.layout) {
      clock_.Begin(Stage::kRefine);
      const refine::RefineOptions refine_options =
          RefineOptionsFor(options_, RefinedBudget(set), will_move_);
      set = refine::SettleSet(*body_, refine_options, pool_, clock_, std::move(set));
    }
    found_.assign(1, {std::move(set), /*has_shape=*/false});
    if (options_.want_polygons) {
      result_.polygons = PolygonResults(features.polygons, stage.approximations, caller_from_body_);
    }
    return CheckCancelled(clock_);
  }

  // What a search may spend: where an error of sections was asked for, as much as the published
  // method took for it.
  [[nodiscard]] capsule::Budget RefinedBudget(const capsule::PrimitiveSet& published) const {
    capsule::Budget budget = TotalBudget(options_);
    if (options_.polygon_error.has_value()) budget.max_primitives = published.primitive_count();
    return budget;
  }

  absl::Status Refine() {
    clock_.Begin(Stage::kRefine);
    capsule::Budget budget = options_.polygon_error.has_value() ? RefinedBudget(found_.front().set)
                                                                : TotalBudget(options_);
    if (ProfileOf(options_) == capsule::CapsuleProfile::kUniformRadius) {
      // A tree: spheres without a capsule would be shapes of their own.
      budget.max_spheres = budget.max_capsules + 1;
    }
    if (!ComparesWithPaper(options_)) found_.clear();
    capsule::PrimitiveSet refined;
    BesideCoverGround([&] {
      refined = refine::RefineSet(*body_, target_, RefineOptionsFor(options_, budget, will_move_),
                                  pool_, clock_);
    });
    found_.insert(found_.begin(), {std::move(refined), /*has_shape=*/true});
    return CheckCancelled(clock_);
  }

  absl::Status CheckFound() const {
    if (!found_.front().set.spheres.empty()) return absl::OkStatus();
    return Refused(ErrorReason::kNothingToFit,
                   "none of the parts asked for was found on this body; see the warnings");
  }

  // Encloses what is not enclosed yet, and proves it; after refining, that is part of it. The best
  // fit is only measured.
  absl::Status Cover() {
    clock_.Begin(Stage::kCoverage);
    if (options_.fit == FitMode::kBestFit) {
      set_ = std::move(found_.front().set);
      max_gap_m_ = coverage::CertifiedGap(target_, set_, kGapAccuracyM, pool_);
      return CheckCancelled(clock_);
    }
    std::vector<coverage::CoverReport> reports = CoverAll();
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(clock_));
    const auto smallest =
        std::min_element(reports.begin(), reports.end(),
                         [](const auto& a, const auto& b) { return a.volume_m3 < b.volume_m3; });
    coverage::CoverReport& report = *smallest;
    set_ = std::move(found_[smallest - reports.begin()].set);
    max_gap_m_ = report.certified_gap_m;
    if (CoversLast(options_, *body_)) at_vertices_ = std::move(report.at_vertices);
    if (ProfileOf(options_) == capsule::CapsuleProfile::kLerpedRadius)
      capsule::GrowForLerpedRadius(set_);
    return CheckCancelled(clock_);
  }

  absl::Status CoverMotion(const formats::PolygonSoup& soup) {
    result_.motion = CoverPoses({*body_, target_, soup}, options_, pool_, clock_, set_, max_gap_m_);
    return CheckCancelled(clock_);
  }

  // Side by side where there are several.
  std::vector<coverage::CoverReport> CoverAll() {
    std::vector<coverage::CoverReport> reports(found_.size());
    if (found_.size() == 1) {
      reports[0] = CoverOne(found_[0], clock_, &backlog_);
      return reports;
    }
    pool_.ForEach(found_.size(), [&](std::size_t i) {
      QuietObserver quiet(clock_);
      reports[i] = CoverOne(found_[i], quiet, nullptr);
    });
    return reports;
  }

  coverage::CoverReport CoverOne(FoundSet& found, FitObserver& observer, Backlog* backlog) const {
    coverage::CoverOptions cover_options = CoverOptionsFor(options_, found.has_shape);
    cover_options.wants_volume = found_.size() > 1;
    return coverage::CoverBody(target_, cover_options, pool_, observer, found.set,
                               cover_ground_ ? &*cover_ground_ : nullptr, backlog);
  }

  metrics::MeasureOptions ToMeasure() const {
    metrics::MeasureOptions measure_options;
    measure_options.parts = options_.parts;
    return measure_options;
  }

  absl::Status Measure() {
    clock_.Begin(Stage::kMetrics);
    backlog_.Finish();
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(clock_));
    std::optional<Warning> overlap =
        WarningOfOverlap(*body_, measure_ground_->rows.MeasureOverlap());
    if (overlap) result_.warnings.push_back(*std::move(overlap));
    result_.metrics =
        metrics::Measure(*body_, *measure_ground_, set_, ToMeasure(), pool_, clock_, at_vertices_);
    result_.metrics.max_gap_m = max_gap_m_;
    WarnOfTolerance();
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(clock_));
    if (options_.want_vertex_gaps) {
      result_.vertex_gaps =
          VertexGaps(body_->enclosed().vertex_of_source,
                     metrics::SignedGaps(*body_, set_, options_.parts, pool_), caller_from_body_);
    }
    return CheckCancelled(clock_);
  }

  // Limbs are thin: what may stick out by three centimetres is nearly all of an arm.
  void WarnOfTolerance() {
    const double uncovered = result_.metrics.uncovered;
    if (options_.tolerance_m <= 0.0 || uncovered < kHollow) return;
    result_.warnings.push_back(
        {"TOLERANCE_HOLLOWS",
         absl::StrFormat("the tolerance of %.3g mm leaves %.0f %% of the fitted parts' volume "
                         "outside of the set",
                         1e3 * options_.tolerance_m, 100.0 * uncovered),
         0});
  }

  absl::Status Bind(const formats::PolygonSoup& soup) {
    result_.primitives = ToCallerFrame(set_, caller_from_body_);
    result_.sphere_names = options_.layout ? NamesOf(*options_.layout) : SphereNames(*body_, set_);
    result_.sphere_places = refine::PlacesOf(*skeleton_, set_);
    if (!options_.want_polygons || IsSearched(options_)) {
      // An index of a polygon that is not in the result would say nothing.
      for (capsule::SphereOrigin& origin : result_.primitives.origins) origin.polygon = -1;
    }
    result_.joints = soup.joints;
    if (options_.skinning == SkinningMode::kNone && !HasRig(soup)) return absl::OkStatus();
    clock_.Begin(Stage::kSkinning);
    BindSpheres(soup, *body_, set_, options_.skinning, pool_, clock_, result_);
    return CheckCancelled(clock_);
  }

  static constexpr int kMaxCirclesPerPolygon = 8;
  // Every polygon's share is weighed with at least so many; the rest is fitted when asked for.
  static constexpr int kCirclesFittedAhead = 2;
  static constexpr int kUsualPrimitives = 64;    // where the budget does not tell
  static constexpr double kHollow = 0.2;         // see TOLERANCE_HOLLOWS in docs/errors.md
  static constexpr double kGapAccuracyM = 1e-3;  // of the best fit's certificate

  const FitOptions& asked_;
  FitOptions options_;  // with the limits of the engine
  const ThreadPool& pool_;
  StageClock& clock_;
  Backlog backlog_;  // what naming and measuring need
  FitResult& result_;
  std::optional<body::Body> body_;  // set by Understand
  geometry::Similarity caller_from_body_;
  tighten::CoverTarget target_;
  bool will_move_ = false;
  bool has_cover_ground_ = false;
  std::optional<coverage::CoverGround> cover_ground_;
  std::optional<metrics::MeasureGround> measure_ground_;
  std::optional<refine::Skeleton> skeleton_;
  std::vector<FoundSet> found_;          // set by Build
  capsule::PrimitiveSet set_;            // set by Cover: the smallest of those, once they cover
  double max_gap_m_ = 0.0;               // certified
  tighten::UnionDistances at_vertices_;  // of the target's points; empty where not known
};

}  // namespace

refine::KeptLayout LayoutOf(const FitResult& result) {
  refine::KeptLayout layout;
  layout.capsules = result.primitives.capsules;
  for (std::size_t i = 0; i < result.primitives.spheres.size(); ++i) {
    const capsule::SphereOrigin& origin = result.primitives.origins[i];
    layout.spheres.push_back(
        {result.sphere_names[i], origin.part, origin.mirror, result.sphere_places[i]});
  }
  return layout;
}

absl::StatusOr<FitResult> Fit(const formats::PolygonSoup& soup, const FitOptions& options,
                              const ThreadPool& pool, FitObserver& observer) {
  CAPFIT_RETURN_IF_ERROR(ValidateOptions(options));
  const ThreadPool::Job job(pool);
  FitResult result;
  result.version = std::string(Version());
  StageClock clock(options, observer, result);
  const absl::Status status = BodyFit(options, pool, clock, result).Run(soup);
  if (!status.ok()) {
    // What was looked at in part only may have been refused for what the rest would have shown.
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    return WithWarnings(status, result.warnings);
  }
  clock.End();
  return result;
}

}  // namespace capfit::pipeline
