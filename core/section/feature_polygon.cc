#include "core/section/feature_polygon.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "core/base/enum_index.h"
#include "core/section/outline.h"
#include "core/section/part_section.h"
#include "core/section/stations.h"
#include "core/section/valleys.h"

namespace capfit::section {
namespace {

using body::Part;

// Ratio of breast height to chest width above which a bust is split (paper, III-E.2).
constexpr double kBreastHeightRatio = 0.04;
// How far below the bust, in heights, the chest carries the breasts no more.
constexpr double kUnderBust = 0.06;
// Share of the width that the valley between the buttocks must be deep to split a hip.
constexpr double kButtockValley = 0.005;
// Where a plane gives no outline, the next ones are tried this share of the height further in.
constexpr double kRetryStep = 0.006;
constexpr int kRetries = 4;
// Where head, hand or foot is missing, the last outline may be this much smaller than one a little
// further in; below it the plane has met a slanting cut.
constexpr double kCutOff = 0.85;
// An outline smaller than this share of the body's height squared is a scrap, not a section.
constexpr double kLeastArea = 1e-5;

// One plane to be cut, and what came of it.
struct Job {
  Part chain = Part::kTorso;
  int order = 0;
  bool may_be_cut = false;  // the last plane of a chain that ends in nothing
  Station station;
  std::optional<FeaturePolygon> polygon;
};

int CountFor(Part chain, const SectionOptions& options) {
  switch (chain) {
    case Part::kTorso:
      return options.torso_polygons;
    case Part::kLeftArm:
    case Part::kRightArm:
      return options.arm_polygons;
    default:
      return options.leg_polygons;
  }
}

bool IsRight(Part chain) { return chain == Part::kRightArm || chain == Part::kRightLeg; }

class Extractor {
 public:
  Extractor(const body::Body& body, const SectionOptions& options, const ThreadPool& pool,
            const FitObserver& observer)
      : body_(body), cutter_(body, pool), options_(options), pool_(pool), observer_(observer) {}

  FeaturePolygons Run() {
    std::vector<Job> jobs = PlanJobs();
    pool_.ForEach(jobs.size(), [&](std::size_t i) {
      if (!observer_.IsCancelled()) jobs[i].polygon = Cut(jobs[i]);
    });
    if (observer_.IsCancelled()) return {};
    Gather(jobs);
    if (body_.is_symmetric) AddMirrorImages();
    SplitHip();
    SplitBust();
    return std::move(result_);
  }

 private:
  // On a symmetric body the right limbs follow from the left ones where there are any.
  bool FollowsFromLeft(Part chain) const {
    return body_.is_symmetric && IsRight(chain) && body_.chain(body::MirrorPart(chain));
  }

  std::vector<Job> PlanJobs() const {
    std::array<std::vector<Station>, body::kChainCount> stations;
    pool_.ForEach(stations.size(), [&](std::size_t c) {
      const Part chain = static_cast<Part>(c);
      if (!body_.chain(chain) || !options_.parts.Includes(chain) || FollowsFromLeft(chain)) return;
      if (observer_.IsCancelled()) return;
      stations[c] = PlanStations(cutter_, chain, CountFor(chain, options_));
    });
    std::vector<Job> jobs;
    for (std::size_t c = 0; c < stations.size(); ++c) {
      for (std::size_t i = 0; i < stations[c].size(); ++i) {
        const bool may_be_cut = i + 1 == stations[c].size() && EndsOpen(static_cast<Part>(c));
        jobs.push_back(
            {static_cast<Part>(c), static_cast<int>(i), may_be_cut, stations[c][i], std::nullopt});
      }
    }
    return jobs;
  }

  // No head, hand or foot follows the chain.
  bool EndsOpen(Part chain) const {
    constexpr std::array<Part, body::kChainCount> kNext{
        Part::kHead, Part::kLeftHand, Part::kRightHand, Part::kLeftFoot, Part::kRightFoot};
    const Part next = kNext[Index(chain)];
    return !body::PartsAmong(body_.vertex_segments)[Index(next)];
  }

  // Cuts at the station, else a little further towards the middle of the chain; clear of a slanting
  // end where the body was cut.
  std::optional<FeaturePolygon> Cut(const Job& job) const {
    const double length = body_.chain(job.chain)->length_m();
    const double inward = job.station.arc_length_m > 0.5 * length ? -1.0 : 1.0;
    std::optional<FeaturePolygon> outer;
    for (int retry = 0; retry <= kRetries; ++retry) {
      const double at = job.station.arc_length_m + retry * inward * kRetryStep * body_.height_m;
      const geometry::PlaneFrame frame = PlaneAt(body_, job.chain, at);
      std::optional<Polygon> outline = Outline(job.chain, frame);
      if (!outline) continue;
      if (outer && outer->outline.area_m2() >= kCutOff * outline->area_m2()) return outer;
      outer = FeaturePolygon{job.chain, job.station.name,    job.order,    at,
                             frame,     *std::move(outline), std::nullopt, -1};
      if (!job.may_be_cut) return outer;
    }
    return outer;
  }

  std::optional<Polygon> Outline(Part chain, const geometry::PlaneFrame& frame) const {
    const auto raw = cutter_.Cut(chain, frame);
    if (!raw) return std::nullopt;
    const int count = std::max(12, options_.outline_points);
    std::vector<Eigen::Vector2d> points;
    if (chain == Part::kTorso && body_.is_symmetric) {
      auto symmetric = Symmetrised(*raw, count);
      if (!symmetric) return std::nullopt;
      points = *std::move(symmetric);
    } else {
      points = Resample(*raw, count);
    }
    if (SignedArea(points) < kLeastArea * body_.height_m * body_.height_m) return std::nullopt;
    absl::StatusOr<Polygon> polygon = Polygon::Create(std::move(points));
    if (!polygon.ok()) return std::nullopt;
    return *std::move(polygon);
  }

  void Gather(std::vector<Job>& jobs) {
    for (Job& job : jobs) {
      if (!job.polygon) {
        result_.warnings.push_back(
            {"SECTION_MISSED",
             "the plane at " + job.station.name + " found no section of its part and was left out",
             1});
        continue;
      }
      FeaturePolygon& polygon = result_.polygons.emplace_back(*std::move(job.polygon));
      const std::size_t n = result_.polygons.size();
      const bool is_first = n < 2 || result_.polygons[n - 2].chain != polygon.chain;
      polygon.order = is_first ? 0 : result_.polygons[n - 2].order + 1;
    }
  }

  void AddMirrorImages() {
    std::vector<FeaturePolygon> all;
    for (int c = 0; c < body::kChainCount; ++c) {
      const Part chain = static_cast<Part>(c);
      for (const FeaturePolygon& polygon : result_.polygons) {
        if (polygon.chain == chain) all.push_back(polygon);
      }
      if (!FollowsFromLeft(chain) || !options_.parts.Includes(chain)) continue;
      for (const FeaturePolygon& polygon : result_.polygons) {
        if (polygon.chain == body::MirrorPart(chain)) all.push_back(ImageOf(polygon));
      }
    }
    result_.polygons = std::move(all);
    LinkImages();
  }

  static FeaturePolygon ImageOf(const FeaturePolygon& polygon) {
    const std::span<const Eigen::Vector2d> vertices = polygon.outline.vertices();
    std::vector<Eigen::Vector2d> image;
    for (auto v = vertices.rbegin(); v != vertices.rend(); ++v) image.emplace_back(-v->x(), v->y());
    FeaturePolygon mirrored = polygon;
    mirrored.chain = body::MirrorPart(polygon.chain);
    mirrored.name.replace(0, 4, "right");  // "left_knee"
    mirrored.frame = MirroredFrame(polygon.frame);
    mirrored.outline = Polygon::Create(std::move(image)).value();
    return mirrored;
  }

  void LinkImages() {
    std::vector<FeaturePolygon>& polygons = result_.polygons;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      const Part other = body::MirrorPart(polygons[i].chain);
      for (std::size_t j = 0; j < polygons.size(); ++j) {
        if (polygons[j].chain != other || polygons[j].order != polygons[i].order) continue;
        polygons[i].mirror = static_cast<int>(j);
      }
    }
  }

  FeaturePolygon* Find(const std::string& name) {
    for (FeaturePolygon& polygon : result_.polygons) {
      if (polygon.name == name) return &polygon;
    }
    return nullptr;
  }

  // Valleys on the side of the outline that lies towards `direction` (body frame).
  static std::optional<Valleys> ValleysTowards(const FeaturePolygon& polygon,
                                               const Eigen::Vector3d& direction) {
    const Eigen::Vector2d outward(direction.dot(polygon.frame.x_axis),
                                  direction.dot(polygon.frame.y_axis));
    if (outward.norm() < 0.1) return std::nullopt;
    return FindValleys(polygon.outline.vertices(), outward.normalized());
  }

  void SplitHip() {
    FeaturePolygon* const hip = Find("hip");
    if (hip == nullptr) return;
    const auto valleys = ValleysTowards(*hip, -Eigen::Vector3d::UnitZ());
    if (!valleys || valleys->middle_depth_m < kButtockValley * valleys->width_m) return;
    hip->split = SplitAtValleys(hip->outline.vertices().size(), *valleys);
  }

  // How far the breasts stand out: beyond the valley between them, and beyond the chest straight
  // below them, whichever is less. Muscles of the chest have a valley, too, but no step below.
  double BreastHeight(const FeaturePolygon& bust, const Valleys& valleys) const {
    double height = valleys.bulge_height_m;
    const geometry::PlaneFrame below =
        PlaneAt(body_, Part::kTorso, bust.arc_length_m - kUnderBust * body_.height_m);
    const auto chest = cutter_.Cut(Part::kTorso, below);
    if (!chest) return height;
    const Eigen::Vector3d ahead = Ahead(bust.frame);
    for (const int apex : valleys.apex) {
      const Eigen::Vector3d tip = bust.frame.ToSpace(bust.outline.vertices()[apex]);
      height = std::min(height, ahead.dot(tip) - FrontAt(*chest, below, tip.x(), ahead));
    }
    return std::max(0.0, height);
  }

  // How far an outline reaches ahead where it passes `x` (body frame).
  static double FrontAt(std::span<const Eigen::Vector2d> outline, const geometry::PlaneFrame& frame,
                        double x, const Eigen::Vector3d& ahead) {
    double front = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector3d a = frame.ToSpace(outline[i]);
      const Eigen::Vector3d b = frame.ToSpace(outline[(i + 1) % outline.size()]);
      if ((a.x() < x) == (b.x() < x)) continue;
      const double t = (x - a.x()) / (b.x() - a.x());
      front = std::max(front, ahead.dot(a + t * (b - a)));
    }
    return front;
  }

  // Forward (+Z) as far as the plane allows.
  static Eigen::Vector3d Ahead(const geometry::PlaneFrame& frame) {
    const Eigen::Vector3d normal = frame.Normal();
    return (Eigen::Vector3d::UnitZ() - normal.z() * normal).normalized();
  }

  void SplitBust() {
    FeaturePolygon* const bust = Find("bust");
    if (bust == nullptr) return;
    const auto valleys = ValleysTowards(*bust, Eigen::Vector3d::UnitZ());
    if (!valleys) return;
    result_.breast_height_ratio = BreastHeight(*bust, *valleys) / valleys->width_m;
    const bool by_shape = result_.breast_height_ratio > kBreastHeightRatio;
    const bool split = options_.sex == Sex::kFemale || (options_.sex == Sex::kAuto && by_shape);
    if (!split) return;
    bust->split = SplitAtValleys(bust->outline.vertices().size(), *valleys);
    result_.bust_is_split = true;
  }

  const body::Body& body_;
  const PartCutter cutter_;
  const SectionOptions& options_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  FeaturePolygons result_;
};

}  // namespace

FeaturePolygons ExtractFeaturePolygons(const body::Body& body, const SectionOptions& options,
                                       const ThreadPool& pool, const FitObserver& observer) {
  return Extractor(body, options, pool, observer).Run();
}

}  // namespace capfit::section
