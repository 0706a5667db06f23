#include "core/circle/cover_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/circle/circle_outside_area.h"

namespace capfit::circle {
namespace {

// In the first rounds the middle of each gap goes to a circle, which is then fitted anew: gaps
// halve in every round, each time at the expense of the circle to which it matters least. Later
// rounds take in whole gaps and only grow circles about their centres, so that nothing that was
// covered opens again and the loop ends.
constexpr int kRounds = 40;
constexpr int kFitSteps = 5;

struct Stretch {
  double begin = 0.0;
  double end = 0.0;
};

void AddEdgeGaps(std::span<const Circle> circles, const Eigen::Vector2d& p,
                 const Eigen::Vector2d& q, double tolerance, std::vector<Gap>& gaps) {
  const Eigen::Vector2d e = q - p;
  const double a = e.squaredNorm();
  if (a == 0.0) return;
  std::vector<Stretch> inside;
  for (const Circle& circle : circles) {
    const Eigen::Vector2d u = p - circle.center_m;
    const double r = circle.radius_m + tolerance;
    const double half_b = u.dot(e);
    const double root2 = half_b * half_b - a * (u.squaredNorm() - r * r);
    if (root2 < 0.0) continue;
    const double root = std::sqrt(root2);
    const Stretch stretch{(-half_b - root) / a, (-half_b + root) / a};
    if (stretch.end < 0.0 || stretch.begin > 1.0) continue;
    if (stretch.begin <= 0.0 && stretch.end >= 1.0) return;  // the usual case
    inside.push_back(stretch);
  }
  std::sort(inside.begin(), inside.end(),
            [](const Stretch& s, const Stretch& t) { return s.begin < t.begin; });
  double reached = 0.0;
  for (const Stretch& stretch : inside) {
    if (stretch.begin > reached) gaps.push_back({p + reached * e, p + stretch.begin * e});
    reached = std::max(reached, stretch.end);
  }
  if (reached < 1.0) gaps.push_back({p + reached * e, q});
}

bool Covered(std::span<const Circle> circles, std::size_t i, std::size_t j,
             const Eigen::Vector2d& point, double tolerance) {
  for (std::size_t k = 0; k < circles.size(); ++k) {
    if (k == i || k == j) continue;
    if ((point - circles[k].center_m).norm() <= circles[k].radius_m + tolerance) return true;
  }
  return false;
}

void AddHoleCorners(std::span<const Circle> circles, std::size_t i, std::size_t j,
                    const section::Polygon& outline, double tolerance, std::vector<Gap>& gaps) {
  const Eigen::Vector2d between = circles[j].center_m - circles[i].center_m;
  const double distance = between.norm();
  const double ri = circles[i].radius_m + tolerance;
  const double rj = circles[j].radius_m + tolerance;
  if (distance == 0.0 || distance > ri + rj || distance < std::abs(ri - rj)) return;
  const double along = (distance * distance + ri * ri - rj * rj) / (2.0 * distance);
  const double across = std::sqrt(std::max(0.0, ri * ri - along * along));
  const Eigen::Vector2d axis = between / distance;
  const Eigen::Vector2d foot = circles[i].center_m + along * axis;
  for (const double side : {across, -across}) {
    const Eigen::Vector2d point = foot + side * Eigen::Vector2d(-axis.y(), axis.x());
    if (!Covered(circles, i, j, point, tolerance) && outline.Contains(point)) {
      gaps.push_back({point, point});
    }
  }
}

// Nearer than this a circle runs through a hole's corner: rounding and tolerances are far smaller,
// holes worth closing far larger.
constexpr double kOnCircleM = 1e-8;

class Closer {
 public:
  Closer(const section::Polygon& outline, bool mirrored, int fitting_rounds,
         std::vector<Cluster>& clusters)
      : outline_(outline),
        mirrored_(mirrored),
        fitting_rounds_(fitting_rounds),
        clusters_(clusters) {}

  void Run(double tolerance) {
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Gap> gaps = FindGaps(AllCircles(clusters_), outline_, 0.25 * tolerance);
      if (gaps.empty()) return;
      for (const Gap& gap : gaps) {
        if (mirrored_ && gap.begin_m.x() + gap.end_m.x() < -tolerance) continue;  // its image comes
        if (round < fitting_rounds_) {
          FitToMiddle(gap);
        } else {
          GrowOver(gap);
        }
      }
    }
    GrowAll(tolerance);
  }

 private:
  // A circle that could take in a gap: of a cluster, or of a pair the mirror image.
  struct Candidate {
    std::size_t cluster = 0;
    bool image = false;
    double growth = std::numeric_limits<double>::infinity();  // of the radius, about the centre
  };

  // The two circles nearest to the gap. A hole's corner lies on two circles' boundaries, which
  // cannot close the hole by growing a little: they come last.
  std::array<Candidate, 2> Nearest(const Gap& gap, bool whole_hole) const {
    std::array<Candidate, 2> nearest;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      for (const bool image : {false, true}) {
        if (image && clusters_[i].place != Place::kPaired) continue;
        const Circle circle = image ? Mirrored(clusters_[i].circle) : clusters_[i].circle;
        const double needed =
            std::max((gap.begin_m - circle.center_m).norm(), (gap.end_m - circle.center_m).norm());
        const bool useless = whole_hole && needed <= circle.radius_m + kOnCircleM;
        const Candidate candidate{i, image, useless ? 1e9 : needed - circle.radius_m};
        if (candidate.growth < nearest[0].growth) {
          nearest = {candidate, nearest[0]};
        } else if (candidate.growth < nearest[1].growth) {
          nearest[1] = candidate;
        }
      }
    }
    return nearest;
  }

  static Eigen::Vector2d Own(const Eigen::Vector2d& point, bool image) {
    return image ? Eigen::Vector2d(-point.x(), point.y()) : point;
  }

  // Gives the gap's middle to that one of the two nearest circles which loses less by it.
  void FitToMiddle(const Gap& gap) {
    const Eigen::Vector2d middle = Middle(gap);
    Cluster best;
    std::size_t best_index = clusters_.size();
    double least = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : Nearest({middle, middle}, false)) {
      if (candidate.growth <= 0.0) return;  // closed by the way
      if (candidate.growth == std::numeric_limits<double>::infinity()) continue;
      Cluster cluster = clusters_[candidate.cluster];
      const double before = cluster.outside_area_m2;
      cluster.hull.push_back(Own(middle, candidate.image));
      Refit(cluster);
      const double cost = CircleCount(cluster.place) * (cluster.outside_area_m2 - before);
      if (cost >= least) continue;
      least = cost;
      best = std::move(cluster);
      best_index = candidate.cluster;
    }
    if (best_index < clusters_.size()) clusters_[best_index] = std::move(best);
  }

  // The middle of an edge's gap; of a hole the middle between a corner and the circle across.
  Eigen::Vector2d Middle(const Gap& gap) const {
    if (gap.begin_m != gap.end_m) return 0.5 * (gap.begin_m + gap.end_m);
    const Candidate across = Nearest(gap, true)[0];
    if (across.growth >= 1e9) return gap.begin_m;
    const Eigen::Vector2d center = Own(clusters_[across.cluster].circle.center_m, across.image);
    return gap.begin_m + 0.5 * across.growth * (center - gap.begin_m).normalized();
  }

  void GrowOver(const Gap& gap) {
    const Candidate nearest = Nearest(gap, gap.begin_m == gap.end_m)[0];
    Cluster& cluster = clusters_[nearest.cluster];
    for (const Eigen::Vector2d& p : {gap.begin_m, gap.end_m}) {
      const Eigen::Vector2d own = Own(p, nearest.image);
      cluster.hull.push_back(own);
      cluster.circle.radius_m =
          std::max(cluster.circle.radius_m, (own - cluster.circle.center_m).norm());
    }
    cluster.outside_area_m2 = CircleOutsideArea(cluster.circle, outline_);
  }

  void Refit(Cluster& cluster) const {
    const CircleFit fit =
        FitCircle(outline_, cluster.hull, cluster.circle.center_m, cluster.place, kFitSteps);
    cluster.circle = fit.circle;
    cluster.outside_area_m2 = fit.outside_area_m2;
  }

  // The net below the loop: ends for certain, because circles that grow cover everything at last.
  void GrowAll(double tolerance) {
    for (double growth = tolerance;; growth *= 2.0) {
      if (FindGaps(AllCircles(clusters_), outline_, 0.25 * tolerance).empty()) return;
      for (Cluster& cluster : clusters_) cluster.circle.radius_m += growth;
    }
  }

  const section::Polygon& outline_;
  bool mirrored_;
  int fitting_rounds_;
  std::vector<Cluster>& clusters_;
};

}  // namespace

std::vector<Gap> FindGaps(std::span<const Circle> circles, const section::Polygon& outline,
                          double tolerance_m) {
  std::vector<Gap> gaps;
  const std::span<const Eigen::Vector2d> vertices = outline.vertices();
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Eigen::Vector2d& next = vertices[k + 1 < vertices.size() ? k + 1 : 0];
    AddEdgeGaps(circles, vertices[k], next, tolerance_m, gaps);
  }
  if (!gaps.empty()) return gaps;  // circles cross there as well, and closing the edge closes that
  for (std::size_t i = 0; i < circles.size(); ++i) {
    for (std::size_t j = i + 1; j < circles.size(); ++j) {
      // Larger than for the edges: circles that just meet on an edge then cross outside of it.
      AddHoleCorners(circles, i, j, outline, 2.0 * tolerance_m, gaps);
    }
  }
  return gaps;
}

void CloseGaps(const section::Polygon& outline, bool mirrored, int fitting_rounds,
               double tolerance_m, std::vector<Cluster>& clusters) {
  Closer(outline, mirrored, fitting_rounds, clusters).Run(tolerance_m);
}

}  // namespace capfit::circle
