#include "tests/core/body/mannequin_trial.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/enum_index.h"
#include "core/base/random.h"
#include "tests/support/random_mannequin.h"

namespace capfit::body {
namespace {

using Eigen::Vector3d;

constexpr double kNoiseM = 0.002;
constexpr double kDroppedShare = 0.05;
// Noise, and a hole closed where the tip was, may move a point of the skin by this much.
constexpr double kOnSkinM = 0.012;

double Normal(Random& random) {
  double sum = -6.0;  // of twelve uniform numbers: close enough to the bell curve
  for (int i = 0; i < 12; ++i) sum += random.NextUnit();
  return sum;
}

Vector3d Anyhow(Random& random, double reach) {
  const double x = random.NextIn(-reach, reach);
  const double y = random.NextIn(-reach, reach);
  return {x, y, random.NextIn(-reach, reach)};
}

void AddNoise(Random& random, double sigma_m, formats::PolygonSoup& soup) {
  for (Vector3d& p : soup.positions) {
    for (int k = 0; k < 3; ++k) p[k] += sigma_m * Normal(random);
  }
}

void DropFaces(Random& random, double share, formats::PolygonSoup& soup) {
  formats::PolygonSoup kept;
  std::size_t at = 0;
  const std::size_t faces =
      soup.face_sizes.empty() ? soup.face_vertices.size() / 3 : soup.face_sizes.size();
  for (std::size_t f = 0; f < faces; ++f) {
    const std::uint32_t size = soup.face_sizes.empty() ? 3 : soup.face_sizes[f];
    if (random.NextUnit() >= share) {
      kept.face_sizes.push_back(size);
      const auto first = soup.face_vertices.begin() + static_cast<std::ptrdiff_t>(at);
      kept.face_vertices.insert(kept.face_vertices.end(), first, first + size);
    }
    at += size;
  }
  soup.face_sizes = std::move(kept.face_sizes);
  soup.face_vertices = std::move(kept.face_vertices);
}

double ArmAngle(const mannequin::MannequinOptions& options) {
  if (options.arm_angle_rad) return *options.arm_angle_rad;
  constexpr std::array<double, 3> kParts = {2.0, 4.0, 12.0};  // of a half turn: T, A, sides
  return std::numbers::pi / kParts[Index(options.pose)];
}

// The mannequin's surface as triangles; its quads are flat enough to be split anyhow.
class TrialSurface {
 public:
  explicit TrialSurface(const formats::PolygonSoup& soup) {
    std::size_t at = 0;
    const std::size_t faces =
        soup.face_sizes.empty() ? soup.face_vertices.size() / 3 : soup.face_sizes.size();
    for (std::size_t f = 0; f < faces; ++f) {
      const std::uint32_t size = soup.face_sizes.empty() ? 3 : soup.face_sizes[f];
      const auto corner = [&](std::size_t k) { return soup.positions[soup.face_vertices[at + k]]; };
      for (std::size_t k = 2; k < size; ++k) {
        triangles_.push_back({corner(0), corner(k - 1), corner(k)});
      }
      at += size;
    }
  }

  // By the solid angles of all triangles: 4 pi inside, 0 outside.
  [[nodiscard]] bool Contains(const Vector3d& p) const {
    double half_angles = 0.0;
    for (const auto& t : triangles_) {
      const Vector3d a = t[0] - p;
      const Vector3d b = t[1] - p;
      const Vector3d c = t[2] - p;
      const double la = a.norm();
      const double lb = b.norm();
      const double lc = c.norm();
      half_angles += std::atan2(a.dot(b.cross(c)),
                                la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return half_angles > std::numbers::pi;
  }

  [[nodiscard]] double Distance(const Vector3d& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles_) best = std::min(best, DistanceToTriangle(t, p));
    return best;
  }

 private:
  static double DistanceToTriangle(const std::array<Vector3d, 3>& t, const Vector3d& p) {
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    double best = std::numeric_limits<double>::infinity();
    bool is_over = true;
    for (int k = 0; k < 3; ++k) {
      const Vector3d edge = t[(k + 1) % 3] - t[k];
      const Vector3d from = p - t[k];
      is_over = is_over && normal.dot(edge.cross(from)) >= 0.0;
      const double share = from.dot(edge) / std::max(edge.squaredNorm(), 1e-30);
      best = std::min(best, (from - std::clamp(share, 0.0, 1.0) * edge).norm());
    }
    return is_over ? std::abs(normal.normalized().dot(p - t[0])) : best;
  }

  std::vector<std::array<Vector3d, 3>> triangles_;
};

// Where a landmark belongs, in body heights; heights over the soles and distance to the side.
struct Place {
  LandmarkId left;  // the landmark, or that of the left side
  double low;
  double high;
  double inner;  // |x|
  double outer;
};

constexpr std::array<Place, 12> kPlaces = {{{LandmarkId::kHeadTop, 0.97, 1.01, 0.0, 0.02},
                                            {LandmarkId::kNeck, 0.80, 0.89, 0.0, 0.01},
                                            {LandmarkId::kCrotch, 0.43, 0.50, 0.0, 0.01},
                                            {LandmarkId::kWaist, 0.58, 0.70, 0.0, 0.01},
                                            {LandmarkId::kBust, 0.67, 0.79, 0.0, 0.01},
                                            {LandmarkId::kHip, 0.46, 0.58, 0.0, 0.01},
                                            {LandmarkId::kLeftShoulder, 0.76, 0.86, 0.06, 0.16},
                                            {LandmarkId::kLeftHip, 0.47, 0.56, 0.03, 0.09},
                                            {LandmarkId::kLeftKnee, 0.24, 0.33, 0.02, 0.14},
                                            {LandmarkId::kLeftAnkle, 0.02, 0.09, 0.02, 0.14},
                                            {LandmarkId::kLeftToe, -0.01, 0.05, 0.01, 0.16},
                                            {LandmarkId::kLeftHeel, -0.01, 0.05, 0.02, 0.14}}};

bool IsPair(LandmarkId id) { return MirrorLandmark(id) != id; }
bool IsTip(LandmarkId id) { return id == LandmarkId::kHeadTop || id >= LandmarkId::kLeftFingertip; }
bool IsExpected(LandmarkId left, const mannequin::MannequinOptions& options) {
  if (left == LandmarkId::kHeadTop) return options.with_head;
  if (left == LandmarkId::kLeftFingertip) return options.with_hands;
  if (left == LandmarkId::kLeftToe || left == LandmarkId::kLeftHeel) return options.with_feet;
  return true;
}

class Examiner {
 public:
  Examiner(const Body& body, const MannequinTrial& trial)
      : body_(body), trial_(trial), surface_(trial.whole) {}

  std::vector<std::string> Run() && {
    for (const Place& place : kPlaces) {
      for (const int side : IsPair(place.left) ? std::vector{0, 1} : std::vector{0}) {
        ExaminePlace(place, side);
      }
    }
    for (const int side : {0, 1}) ExamineArm(side);
    for (int i = 0; i < kLandmarkCount; ++i) ExamineFlesh(static_cast<LandmarkId>(i));
    return std::move(faults_);
  }

 private:
  [[nodiscard]] static LandmarkId OnSide(LandmarkId left, int side) {
    return side == 0 ? left : MirrorLandmark(left);
  }
  // In the mannequin's own frame, in body heights, the body's left at +X.
  [[nodiscard]] std::optional<Vector3d> At(LandmarkId id) const {
    if (!body_.landmark(id)) return std::nullopt;
    return InWhole(id) / trial_.options.height_m;
  }
  [[nodiscard]] Vector3d InWhole(LandmarkId id) const {
    const Vector3d in_battered =
        body_.body_from_caller.Inverse().Apply(body_.landmark(id)->position_m);
    Vector3d p = trial_.battered_from_whole.Inverse().Apply(in_battered);
    if (trial_.is_mirrored) p.x() = -p.x();
    return p;
  }
  // In a mirrored body the left is what was the right, and lies at -X of the mannequin as made.
  [[nodiscard]] double Outward(const Vector3d& p, int side) const {
    return ((side == 0) != trial_.is_mirrored ? 1.0 : -1.0) * p.x();
  }

  void Fault(LandmarkId id, const std::string& what, const Vector3d& p) {
    char at[96];
    std::snprintf(at, sizeof at, " at (%.3f %.3f %.3f) heights", p.x(), p.y(), p.z());
    faults_.push_back(std::string(LandmarkName(id)) + " " + what + at);
  }

  void ExaminePlace(const Place& place, int side) {
    const LandmarkId id = OnSide(place.left, side);
    const bool is_expected = IsExpected(place.left, trial_.options);
    const auto p = At(id);
    if (p.has_value() != is_expected) {
      faults_.push_back(std::string(LandmarkName(id)) +
                        (is_expected ? " is missing" : " is not there but was found"));
    }
    if (!p || !is_expected) return;
    if (p->y() < place.low || p->y() > place.high) Fault(id, "is at the wrong height", *p);
    const double outward = IsPair(id) ? Outward(*p, side) : std::abs(p->x());
    if (outward < place.inner || outward > place.outer) Fault(id, "is too far in or out", *p);
  }

  // Elbow and wrist lie along the arm, which points where the mannequin's does.
  void ExamineArm(int side) {
    const auto shoulder = At(OnSide(LandmarkId::kLeftShoulder, side));
    const auto elbow = At(OnSide(LandmarkId::kLeftElbow, side));
    const auto wrist = At(OnSide(LandmarkId::kLeftWrist, side));
    if (!shoulder || !elbow || !wrist) {
      faults_.push_back(side == 0 ? "the left arm is missing" : "the right arm is missing");
      return;
    }
    const double upper = (*elbow - *shoulder).norm();
    const double lower = (*wrist - *elbow).norm();
    if (upper < 0.11 || upper > 0.20) Fault(OnSide(LandmarkId::kLeftElbow, side), "off", *elbow);
    if (lower < 0.11 || lower > 0.18) Fault(OnSide(LandmarkId::kLeftWrist, side), "off", *wrist);
    const Vector3d arm = *wrist - *shoulder;
    const double angle = std::atan2(Outward(arm, side), -arm.y());
    if (std::abs(angle - ArmAngle(trial_.options)) > 0.2) {
      Fault(OnSide(LandmarkId::kLeftWrist, side), "in another direction", *wrist);
    }
    const auto tip = At(OnSide(LandmarkId::kLeftFingertip, side));
    if (tip.has_value() != trial_.options.with_hands) {
      faults_.push_back("hand found or missing against the truth");
    } else if (tip && ((*tip - *wrist).norm() < 0.08 || (*tip - *wrist).norm() > 0.14)) {
      Fault(OnSide(LandmarkId::kLeftFingertip, side), "off", *tip);
    }
  }

  void ExamineFlesh(LandmarkId id) {
    if (!body_.landmark(id)) return;
    const Vector3d p = InWhole(id);
    const bool is_on_skin =
        IsTip(id) || id == LandmarkId::kLeftArmpit || id == LandmarkId::kRightArmpit;
    const double distance = surface_.Distance(p);
    if (is_on_skin && distance > kOnSkinM) Fault(id, "is off the skin", p);
    // The crotch lies on the skin too, and so does what ends in a cut.
    if (!is_on_skin && distance > 0.5 * kOnSkinM && !surface_.Contains(p)) {
      Fault(id, "is outside the body", p);
    }
  }

  const Body& body_;
  const MannequinTrial& trial_;
  TrialSurface surface_;
  std::vector<std::string> faults_;
};

}  // namespace

std::string MannequinTrial::Description() const {
  char text[200];
  std::snprintf(text, sizeof text, "%s %.2f m, %zu vertices, arms %.0f degrees%s%s%s%s%s%s",
                options.sex == mannequin::MannequinSex::kFemale ? "female" : "male",
                options.height_m, whole.positions.size(),
                ArmAngle(options) * 180.0 / std::numbers::pi, options.with_head ? "" : ", no head",
                options.with_hands ? "" : ", no hands", options.with_feet ? "" : ", no feet",
                is_mirrored ? ", mirrored" : "", noise_m > 0.0 ? ", noise 2 mm" : "",
                dropped > 0.0 ? ", 5 % of faces dropped" : "");
  return text;
}

MannequinTrial MakeMannequinTrial(std::uint64_t seed) {
  MannequinTrial trial;
  trial.options = mannequin::RandomMannequin(seed);
  trial.whole = *mannequin::MakeMannequin(trial.options);
  trial.battered = trial.whole;
  Random random(seed ^ 0x9E3779B97F4A7C15u);
  trial.is_mirrored = random.NextBelow(2) == 0;
  if (random.NextBelow(3) != 0) trial.noise_m = kNoiseM;
  if (random.NextBelow(3) != 0) trial.dropped = kDroppedShare;
  if (trial.noise_m > 0.0) AddNoise(random, trial.noise_m, trial.battered);
  if (trial.dropped > 0.0) DropFaces(random, trial.dropped, trial.battered);
  geometry::Similarity& turn = trial.battered_from_whole;
  const Vector3d axis = Anyhow(random, 1.0);
  turn.rotation = Eigen::AngleAxisd(random.NextIn(-3.14, 3.14), axis.normalized()).matrix();
  turn.translation = Anyhow(random, 5.0);
  for (Vector3d& p : trial.battered.positions) {
    if (trial.is_mirrored) p.x() = -p.x();
    p = turn.Apply(p);
  }
  return trial;
}

std::vector<std::string> FaultsOf(const Body& body, const MannequinTrial& trial) {
  return Examiner(body, trial).Run();
}

}  // namespace capfit::body
