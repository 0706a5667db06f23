#include "core/section/stations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "core/section/outline.h"

namespace capfit::section {
namespace {

using body::LandmarkId;
using body::Part;

// Shares of the body's height. The first and last planes keep this distance from the end of their
// part: a plane in a flat cut or through a fold would give a torn outline.
constexpr double kEndInset = 0.004;
constexpr double kAboveCrotch = 0.015;  // hip_low
constexpr double kBelowCrotch = 0.010;  // thigh
constexpr double kOffArmpit = 0.015;    // upper_arm
// Where the rearmost point of the buttocks is looked for, above the crotch.
constexpr double kButtocksLow = 0.03;
constexpr double kButtocksHigh = 0.11;
constexpr double kLeastSpacing = 0.012;
// Half the stretch of medial curve that gives a plane its direction.
constexpr double kTangentReach = 0.03;
// Planes of the torso lean by at most this tangent from the mean of upright and the line between
// crotch and neck: a belly or the pelvis bends the curve more than a cut should follow (it would
// pass the crotch in front).
constexpr double kMostLean = 0.14;  // 8 degrees

// A station before a count is chosen; of too many the lowest rank is dropped first.
struct Candidate {
  std::string_view name;
  double arc_length_m = 0.0;
  int rank = 0;
};

struct GapName {
  std::string_view below;
  std::string_view above;
  std::string_view name;
};
constexpr std::array<GapName, 10> kGapNames{{{"hip_low", "hip", "hip_middle"},
                                             {"hip", "waist", "abdomen"},
                                             {"waist", "bust", "under_bust"},
                                             {"bust", "chest", "upper_chest"},
                                             {"chest", "neck", "neck_base"},
                                             {"upper_arm", "elbow", "middle_arm"},
                                             {"elbow", "wrist", "forearm"},
                                             {"thigh", "knee", "middle_thigh"},
                                             {"knee", "calf", "upper_calf"},
                                             {"calf", "ankle", "shin"}}};

std::string NameOfGap(std::string_view below, std::string_view above) {
  for (const GapName& gap : kGapNames) {
    if (gap.below == below && gap.above == above) return std::string(gap.name);
  }
  return std::string(below) + "_to_" + std::string(above);
}

bool IsLeft(Part chain) { return chain == Part::kLeftArm || chain == Part::kLeftLeg; }
bool IsArm(Part chain) { return chain == Part::kLeftArm || chain == Part::kRightArm; }

class Planner {
 public:
  Planner(const PartCutter& cutter, Part chain)
      : cutter_(cutter),
        body_(cutter.body()),
        chain_(chain),
        curve_(*body_.chain(chain)),
        height_(body_.height_m) {}

  std::vector<Station> Run(int count) {
    std::vector<Candidate> candidates = chain_ == Part::kTorso ? Torso()
                                        : IsArm(chain_)        ? Arm()
                                                               : Leg();
    SpreadOut(candidates);
    while (static_cast<int>(candidates.size()) > std::max(2, count)) {
      candidates.erase(
          std::min_element(candidates.begin(), candidates.end(),
                           [](const Candidate& a, const Candidate& b) { return a.rank < b.rank; }));
    }
    return FillUp(candidates, count);
  }

 private:
  double Length() const { return curve_.length_m(); }
  double End() const { return Length() - kEndInset * height_; }

  // The landmark's place on the curve, or a share of the curve.
  double At(LandmarkId left_or_middle, LandmarkId right, double share) const {
    const LandmarkId id = chain_ == Part::kTorso || IsLeft(chain_) ? left_or_middle : right;
    const auto& landmark = body_.landmark(id);
    return landmark ? curve_.Project(landmark->position_m) : share * Length();
  }

  std::vector<Candidate> Torso() const {
    const double waist = At(LandmarkId::kWaist, LandmarkId::kWaist, 0.47);
    const double bust = At(LandmarkId::kBust, LandmarkId::kBust, 0.70);
    const double low = kAboveCrotch * height_;
    const double hip = std::max(Buttocks(), low + 0.02 * height_);
    return {{"hip_low", low, 1},           {"hip", hip, 4},
            {"waist", waist, 3},           {"bust", bust, 0},
            {"chest", Shoulders(bust), 5}, {"neck", End(), 2}};
  }

  std::vector<Candidate> Arm() const {
    const double armpit = At(LandmarkId::kLeftArmpit, LandmarkId::kRightArmpit, 0.15);
    return {{"upper_arm", armpit + kOffArmpit * height_, 2},
            {"elbow", At(LandmarkId::kLeftElbow, LandmarkId::kRightElbow, 0.5), 0},
            {"wrist", End(), 1}};
  }

  std::vector<Candidate> Leg() const {
    const double knee = At(LandmarkId::kLeftKnee, LandmarkId::kRightKnee, 0.48);
    return {
        {"thigh", Crotch(), 3}, {"knee", knee, 1}, {"calf", Calf(knee), 0}, {"ankle", End(), 2}};
  }

  double Crotch() const {
    const auto& crotch = body_.landmark(LandmarkId::kCrotch);
    if (!crotch) return 0.1 * Length();
    const Eigen::Vector3d below =
        crotch->position_m - Eigen::Vector3d(0, kBelowCrotch * height_, 0);
    return curve_.Project(below);
  }

  // Where the buttocks reach furthest back.
  double Buttocks() const {
    const auto& hip = body_.landmark(LandmarkId::kHip);
    const double fallback = hip ? curve_.Project(hip->position_m) : 0.15 * Length();
    const double base = curve_.points_m.front().y();
    const std::span<const Eigen::Vector3d> vertices = body_.mesh.vertices();
    const Eigen::Vector3d* rearmost = nullptr;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const double above = (vertices[v].y() - base) / height_;
      if (above < kButtocksLow || above > kButtocksHigh) continue;
      if (!TakesIn(chain_, body_.vertex_segments[v])) continue;
      if (rearmost == nullptr || vertices[v].z() < rearmost->z()) rearmost = &vertices[v];
    }
    return rearmost == nullptr ? fallback : curve_.Project({0.0, rearmost->y(), 0.0});
  }

  double Shoulders(double bust) const {
    const auto& left = body_.landmark(LandmarkId::kLeftShoulder);
    const auto& right = body_.landmark(LandmarkId::kRightShoulder);
    const double share = bust + 0.55 * (Length() - bust);
    if (!left || !right) return share;
    const double at = curve_.Project(0.5 * (left->position_m + right->position_m));
    return std::clamp(at, bust + 0.25 * (Length() - bust), bust + 0.75 * (Length() - bust));
  }

  // The largest section between knee and ankle.
  double Calf(double knee) const {
    double best = knee + 0.3 * (End() - knee);
    double largest = 0.0;
    for (int k = 3; k <= 9; ++k) {
      const double at = knee + 0.05 * k * (End() - knee);
      const auto outline = cutter_.Cut(chain_, PlaneAt(body_, chain_, at));
      const double area = outline ? SignedArea(*outline) : 0.0;
      if (area <= largest) continue;
      largest = area;
      best = at;
    }
    return best;
  }

  // Landmarks that the body or the caller put in a strange order still give rising stations.
  void SpreadOut(std::vector<Candidate>& candidates) const {
    const double spacing =
        std::min(kLeastSpacing * height_, 0.5 * Length() / static_cast<double>(candidates.size()));
    double highest = End();
    for (std::size_t i = candidates.size(); i-- > 0;) {
      double& at = candidates[i].arc_length_m;
      at = std::clamp(at, 0.0, highest);
      highest = std::max(0.0, at - spacing);
    }
    double lowest = kEndInset * height_;
    for (Candidate& candidate : candidates) {
      candidate.arc_length_m = std::max(candidate.arc_length_m, lowest);
      lowest = candidate.arc_length_m + spacing;
    }
  }

  std::vector<Station> FillUp(const std::vector<Candidate>& candidates, int count) const {
    std::vector<int> extra(candidates.size(), 0);  // stations above each candidate
    for (int i = static_cast<int>(candidates.size()); i < count; ++i) {
      std::size_t widest = 0;
      double width = 0.0;
      for (std::size_t g = 0; g + 1 < candidates.size(); ++g) {
        const double step =
            (candidates[g + 1].arc_length_m - candidates[g].arc_length_m) / (extra[g] + 1);
        if (step <= width) continue;
        width = step;
        widest = g;
      }
      ++extra[widest];
    }
    std::vector<Station> stations;
    for (std::size_t g = 0; g < candidates.size(); ++g) {
      AddStation(std::string(candidates[g].name), candidates[g].arc_length_m, stations);
      for (int k = 1; k <= extra[g]; ++k) {
        const double from = candidates[g].arc_length_m;
        const double step = (candidates[g + 1].arc_length_m - from) / (extra[g] + 1);
        std::string name = NameOfGap(candidates[g].name, candidates[g + 1].name);
        if (extra[g] > 1) absl::StrAppend(&name, "_", k);
        AddStation(name, from + k * step, stations);
      }
    }
    return stations;
  }

  void AddStation(const std::string& name, double at, std::vector<Station>& stations) const {
    const std::string side = chain_ == Part::kTorso ? "" : IsLeft(chain_) ? "left_" : "right_";
    stations.push_back({side + name, at});
  }

  const PartCutter& cutter_;
  const body::Body& body_;
  Part chain_;
  const body::MedialCurve& curve_;
  double height_;
};

// The part of `direction` across `normal`, length 1.
Eigen::Vector3d Across(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal) {
  return (direction - direction.dot(normal) * normal).normalized();
}

// `direction` turned towards `axis` until it leans from it by no more than kMostLean.
Eigen::Vector3d WithinLean(const Eigen::Vector3d& direction, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d upright = axis.normalized();
  const double along = direction.dot(upright);
  const Eigen::Vector3d aside = direction - along * upright;
  if (along > 0.0 && aside.norm() <= kMostLean * along) return direction;
  return (upright + kMostLean * aside.normalized()).normalized();
}

}  // namespace

std::vector<Station> PlanStations(const PartCutter& cutter, body::Part chain, int count) {
  return Planner(cutter, chain).Run(count);
}

geometry::PlaneFrame PlaneAt(const body::Body& body, body::Part chain, double arc_length_m) {
  const body::MedialCurve& curve = *body.chain(chain);
  const double reach = std::min(kTangentReach * body.height_m, 0.25 * curve.length_m());
  Eigen::Vector3d origin = curve.PointAt(arc_length_m);
  Eigen::Vector3d normal =
      (curve.PointAt(arc_length_m + reach) - curve.PointAt(arc_length_m - reach)).normalized();
  if (chain == Part::kTorso) {
    const Eigen::Vector3d trunk = (curve.points_m.back() - curve.points_m.front()).normalized();
    normal = WithinLean(normal, trunk + Eigen::Vector3d::UnitY());
    if (body.is_symmetric) {
      origin.x() = 0.0;
      normal = Eigen::Vector3d(0.0, normal.y(), normal.z()).normalized();
    }
  }
  // Beyond 60 degrees from the plane, "left" would turn with every wobble of the curve.
  const bool is_level = std::abs(normal.x()) > 0.87;
  const Eigen::Vector3d up(0.0, normal.x() > 0.0 ? -1.0 : 1.0, 0.0);
  geometry::PlaneFrame frame;
  frame.origin_m = origin;
  frame.x_axis = Across(is_level ? up : Eigen::Vector3d(Eigen::Vector3d::UnitX()), normal);
  frame.y_axis = normal.cross(frame.x_axis);
  return frame;
}

geometry::PlaneFrame MirroredFrame(const geometry::PlaneFrame& frame) {
  const auto image = [](const Eigen::Vector3d& v) { return Eigen::Vector3d(-v.x(), v.y(), v.z()); };
  return {image(frame.origin_m), -image(frame.x_axis), image(frame.y_axis)};
}

}  // namespace capfit::section
