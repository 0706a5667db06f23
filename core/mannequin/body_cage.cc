#include "core/mannequin/body_cage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mannequin/cage_builder.h"

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr int kHalfColumns = 9;   // of the trunk, from the middle in front to that behind
constexpr int kLimbColumns = 12;  // 9 of the trunk and 3 across the crotch; the armhole's 12
constexpr std::size_t kArmholeFront = 3;  // the armhole is 3 columns wide ...
constexpr std::size_t kArmholeBack = 6;
// A limb's control polygon has 12 corners; the smooth ring lies this much further in.
constexpr double kLimbSwell = 1.05;

double SignedPower(double x, double exponent) {
  return std::copysign(std::pow(std::abs(x), exponent), x);
}

double SmoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Flesh goes more to the front and back than to the sides.
double WidthFactor(double girth_factor) { return std::pow(girth_factor, 0.92); }
double DepthFactor(double girth_factor) { return std::pow(girth_factor, 1.08); }

class BodyCageMaker {
 public:
  explicit BodyCageMaker(const BodyShape& shape)
      : shape_(shape), proportions_(ProportionsOf(shape.sex)) {}

  BodyCage Make() && {
    AddTrunk();
    AddHead();
    AddLeg();
    AddArm();
    cage_.half = std::move(builder_).Take();
    return std::move(cage_);
  }

 private:
  [[nodiscard]] double GirthFactor(const TrunkRing& ring) const {
    return 1.0 + ring.bust * (shape_.bust_factor - 1.0) + ring.waist * (shape_.waist_factor - 1.0) +
           ring.hip * (shape_.hip_factor - 1.0);
  }

  // A ring of the head, grown about the top of the neck.
  [[nodiscard]] TrunkRing HeadRing(TrunkRing r) const {
    const double neck = proportions_.trunk.back().y_side;
    for (double* const y : {&r.y_front, &r.y_side, &r.y_back}) {
      *y = neck + shape_.head_factor * (*y - neck);
    }
    for (double* const reach : {&r.half_width, &r.z_front, &r.z_side, &r.z_back}) {
      *reach *= shape_.head_factor;
    }
    return r;
  }

  // From the middle in front over the left side to the middle behind.
  Ring AddTrunkRing(const TrunkRing& r) {
    const double factor = GirthFactor(r);
    Ring ring;
    for (int j = 0; j <= kHalfColumns; ++j) {
      const double angle = pi * j / kHalfColumns;
      const double c = SignedPower(std::cos(angle), 2.0 / r.squareness);
      const double s = SignedPower(std::sin(angle), 2.0 / r.squareness);
      const double reach = c > 0 ? r.z_front - r.z_side : r.z_side - r.z_back;
      const double drop = (c > 0 ? r.y_front : r.y_back) - r.y_side;
      const bool on_plane = j == 0 || j == kHalfColumns;
      ring.push_back(builder_.Add({on_plane ? 0.0 : WidthFactor(factor) * r.half_width * s,
                                   r.y_side + drop * std::pow(std::cos(angle), 2),
                                   r.z_side + DepthFactor(factor) * reach * c}));
    }
    return ring;
  }

  void AddTrunk() {
    for (const TrunkRing& ring : proportions_.trunk) trunk_.push_back(AddTrunkRing(ring));
    for (std::size_t i = 0; i + 1 < trunk_.size(); ++i) {
      const bool beside_arm = i >= kArmpitRing && i < kAcromionRing;
      for (std::size_t k = 0; k < kHalfColumns; ++k) {
        if (beside_arm && k >= kArmholeFront && k < kArmholeBack) continue;
        builder_.BridgeColumn(trunk_[i + 1], trunk_[i], k);
      }
    }
    cage_.trunk_end = builder_.quad_count();
  }

  // The half ring and four new vertices in the mirror plane, for a cap 5 deep and 2 wide.
  void CapHalfRing(const Ring& ring, double rise) {
    const Vector3d front = builder_.position(ring.front());
    const Vector3d back = builder_.position(ring.back());
    Ring loop = {ring.front()};
    for (int i = 1; i < 5; ++i) {
      const double u = i / 5.0;
      const double lift = rise * std::pow(std::sin(pi * u), 0.7);
      loop.push_back(builder_.Add((1 - u) * front + u * back + Vector3d(0, lift, 0)));
    }
    loop.insert(loop.end(), ring.rbegin(), ring.rend() - 1);
    builder_.Cap(loop, 5, 2, Vector3d::Zero());
  }

  void AddHead() {
    Ring below = trunk_.back();
    if (!shape_.with_head) {
      builder_.Crease(below, false);
      CapHalfRing(below, 0.0);
      return;
    }
    for (const TrunkRing& r : proportions_.head) {
      const Ring ring = AddTrunkRing(HeadRing(r));
      builder_.Bridge(ring, below, false);
      below = ring;
    }
    CapHalfRing(below,
                shape_.head_factor * (proportions_.crown_y - proportions_.head.back().y_side));
  }

  [[nodiscard]] double LegFactor(double y) const {
    const double top = proportions_.leg.front().y;
    return 1.0 + (shape_.hip_factor - 1.0) * (0.25 + 0.75 * SmoothStep((y - 0.1) / (top - 0.1)));
  }
  [[nodiscard]] double LegHalfWidth(const LegRing& r) const {
    return kLimbSwell * r.half_width * WidthFactor(LegFactor(r.y));
  }

  // The axis is straight and as near to the middle as the thighs leave room for.
  void PlaceLegAxis() {
    const LegRing& top = proportions_.leg.front();
    constexpr double kGap = 0.005;
    cage_.leg_x_at_crotch = LegHalfWidth(top) + 0.001;
    cage_.leg_x_at_ankle = 0.046;
    for (const LegRing& r : proportions_.leg.subspan(1)) {
      const double u = (top.y - r.y) / top.y;
      const double needed = (LegHalfWidth(r) + kGap - (1 - u) * cage_.leg_x_at_crotch) / u;
      cage_.leg_x_at_ankle = std::max(cage_.leg_x_at_ankle, needed);
    }
  }
  [[nodiscard]] double LegX(double y) const {
    const double u = 1.0 - y / proportions_.leg.front().y;
    return cage_.leg_x_at_crotch + u * (cage_.leg_x_at_ankle - cage_.leg_x_at_crotch);
  }

  // Column k of a limb looks this way: 0 outward, -90 degrees to the front.
  static double LegAngle(int k) { return (k - 4.5) * 2.0 * pi / kLimbColumns; }

  Ring AddLegRing(const LegRing& r) {
    const double depth = kLimbSwell * DepthFactor(LegFactor(r.y));
    Ring ring;
    for (int k = 0; k < kLimbColumns; ++k) {
      const double ahead = -std::sin(LegAngle(k));
      const double reach = ahead > 0 ? r.z_front : -r.z_back;
      ring.push_back(builder_.Add(
          {LegX(r.y) + LegHalfWidth(r) * std::cos(LegAngle(k)), r.y, depth * reach * ahead}));
    }
    return ring;
  }

  Ring AddFootRing(const FootRing& r) {
    constexpr double kToeOut = 0.14;  // radians
    const Vector3d top(0, r.y_top, r.z_top);
    const Vector3d bottom(0, r.y_bottom, r.z_bottom);
    Ring ring;
    for (int k = 0; k < kLimbColumns; ++k) {
      const double ahead = SignedPower(-std::sin(LegAngle(k)), 0.85);
      const double aside = SignedPower(std::cos(LegAngle(k)), 0.85);
      Vector3d p = 0.5 * (top + bottom) + 0.5 * ahead * (top - bottom);
      p.x() = kLimbSwell * r.half_width * aside;
      const double turn = kToeOut * SmoothStep(1.0 - (r.y_top - 0.03) / 0.03);
      const double x = std::cos(turn) * p.x() + std::sin(turn) * p.z();
      const double z = std::cos(turn) * p.z() - std::sin(turn) * p.x();
      ring.push_back(builder_.Add({LegX(0.04) + x, p.y(), z}));
    }
    return ring;
  }

  Ring HipRing() {
    Ring ring = trunk_.front();
    const Vector3d front = builder_.position(ring.front());
    const Vector3d back = builder_.position(ring.back());
    for (const double u : {2.0 / 3.0, 1.0 / 3.0}) {
      Vector3d p = (1 - u) * front + u * back;
      p.y() -= 0.008;
      ring.push_back(builder_.Add(p));
    }
    return ring;
  }

  void AddLeg() {
    PlaceLegAxis();
    Ring above = HipRing();
    const auto append = [&](const Ring& ring) {
      builder_.Bridge(above, ring, true);
      above = ring;
    };
    for (const LegRing& r : proportions_.leg) append(AddLegRing(r));
    if (!shape_.with_feet) {
      builder_.Crease(above, true);
      builder_.Cap(above, 3, 3, Vector3d::Zero());
      return;
    }
    for (const FootRing& r : proportions_.foot) append(AddFootRing(r));
    builder_.Cap(above, 3, 3, {0.001, 0, 0.006});
  }

  // The 12 trunk vertices around the arm, from the top in front over the back.
  [[nodiscard]] Ring ArmholeRing() const {
    Ring ring;
    for (std::size_t j = kArmholeFront; j < kArmholeBack; ++j)
      ring.push_back(trunk_[kAcromionRing][j]);
    for (std::size_t i = kAcromionRing; i > kArmpitRing; --i)
      ring.push_back(trunk_[i][kArmholeBack]);
    for (std::size_t j = kArmholeBack; j > kArmholeFront; --j)
      ring.push_back(trunk_[kArmpitRing][j]);
    for (std::size_t i = kArmpitRing; i < kAcromionRing; ++i)
      ring.push_back(trunk_[i][kArmholeFront]);
    return ring;
  }

  [[nodiscard]] double ArmFactor(double t) const {
    return 1.0 + (shape_.bust_factor - 1.0) * (0.75 - 0.45 * SmoothStep(t / 0.33));
  }

  // The arm leaves the armhole in a direction between its own and that of the shoulder, and turns
  // into its own over this distance.
  struct AxisPoint {
    Vector3d position;
    double angle_rad;
  };
  [[nodiscard]] AxisPoint ArmAxisAt(const Vector3d& start, double t) const {
    constexpr double kTurnLength = 0.055;
    constexpr int kSteps = 64;
    const double first = 0.50 + 0.60 * shape_.arm_angle_rad;
    const auto angle_at = [&](double s) {
      return first + (shape_.arm_angle_rad - first) * SmoothStep(s / kTurnLength);
    };
    Vector3d p = start;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = angle_at(t * (i + 0.5) / kSteps);
      p += t / kSteps * Vector3d(std::sin(angle), -std::cos(angle), 0.0);
    }
    return {p, angle_at(t)};
  }

  // How far out the trunk's side is at this height, and a little further below the armpit: a
  // hanging arm must not enter the trunk.
  [[nodiscard]] double TrunkSideAt(double y) const {
    const auto rings = proportions_.trunk;
    const auto side = [&](std::size_t i) {
      return WidthFactor(GirthFactor(rings[i])) * rings[i].half_width;
    };
    if (y >= rings[kAcromionRing].y_side || y <= rings[0].y_side) return 0.0;
    std::size_t i = 0;
    while (rings[i + 1].y_side < y) ++i;
    const double u = (y - rings[i].y_side) / (rings[i + 1].y_side - rings[i].y_side);
    const double below = std::max(0.0, rings[kArmpitRing].y_side - y);
    return (1 - u) * side(i) + u * side(i + 1) + 0.004 + std::min(0.15 * below, 0.015);
  }

  Ring AddArmRing(const ArmRing& r, const Vector3d& armhole) {
    const AxisPoint axis = ArmAxisAt(armhole, r.t);
    const Vector3d up(std::cos(axis.angle_rad), std::sin(axis.angle_rad), 0.0);
    const double swell = kLimbSwell * ArmFactor(r.t);
    // The middle finger is the longest.
    const double shortfall = 0.35 * std::max(0.0, r.t - 0.415);
    const Vector3d along(std::sin(axis.angle_rad), -std::cos(axis.angle_rad), 0.0);
    Ring ring;
    for (int k = 0; k < kLimbColumns; ++k) {
      const double angle = pi / 4.0 - k * 2.0 * pi / kLimbColumns;
      Vector3d p = axis.position + swell * r.half_height * std::cos(angle) * up;
      p.z() += r.forward + swell * r.half_depth * std::sin(angle);
      p -= shortfall * std::pow(std::sin(angle), 2) * along;
      p.x() = std::max(p.x(), TrunkSideAt(p.y()));
      ring.push_back(builder_.Add(p));
    }
    return ring;
  }

  void AddArm() {
    Ring inner = ArmholeRing();
    Vector3d armhole = Vector3d::Zero();
    for (const std::uint32_t v : inner) armhole += builder_.position(v) / kLimbColumns;
    const double angle = shape_.arm_angle_rad;
    cage_.arm.along = {std::sin(angle), -std::cos(angle), 0};
    cage_.arm.up = {std::cos(angle), std::sin(angle), 0};
    cage_.arm.origin = ArmAxisAt(armhole, 0.1).position - 0.1 * cage_.arm.along;
    for (const ArmRing& r : proportions_.arm) {
      const Ring ring = AddArmRing(r, armhole);
      builder_.Bridge(inner, ring, true);
      inner = ring;
    }
    if (shape_.with_hands) {
      AddHand(inner, armhole);
    } else {
      builder_.Crease(inner, true);
      builder_.Cap(inner, 3, 3, Vector3d::Zero());
    }
  }

  void AddHand(const Ring& forearm, const Vector3d& armhole) {
    std::vector<Ring> rings = {forearm};
    for (const ArmRing& r : proportions_.hand) rings.push_back(AddArmRing(r, armhole));
    constexpr std::size_t kThumbColumn = 10;
    constexpr std::size_t kThumbRing = 2;  // the thumb leaves beside the two bands after it
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      for (std::size_t k = 0; k < kLimbColumns; ++k) {
        const bool beside_thumb = i == kThumbRing || i == kThumbRing + 1;
        if (!(beside_thumb && k == kThumbColumn)) builder_.BridgeColumn(rings[i], rings[i + 1], k);
      }
    }
    CapFingers(rings.back());
    AddThumb({rings[kThumbRing][10], rings[kThumbRing][11], rings[kThumbRing + 1][11],
              rings[kThumbRing + 2][11], rings[kThumbRing + 2][10], rings[kThumbRing + 1][10]});
  }

  // A grid 5 wide and 1 high: the ring again, from the corner before the top.
  void CapFingers(const Ring& ring) {
    Ring turned = {ring.back()};
    turned.insert(turned.end(), ring.begin(), ring.end() - 1);
    builder_.Cap(turned, 5, 1, Vector3d::Zero());
  }

  void AddThumb(const Ring& root) {
    Vector3d center = Vector3d::Zero();
    for (const std::uint32_t v : root) center += builder_.position(v) / 6.0;
    const Vector3d ahead = Vector3d::UnitZ();
    const Vector3d along =
        (0.70 * cage_.arm.along + 0.70 * ahead - 0.20 * cage_.arm.up).normalized();
    const Vector3d across = along.cross(cage_.arm.up).normalized();
    const Vector3d up = across.cross(along);
    Ring inner = root;
    for (const auto& [t, radius] : {std::pair{.014, .0100}, {.028, .0092}, {.041, .0070}}) {
      Ring ring;
      for (std::size_t k = 0; k < 6; ++k) {
        // The root's order: proximal bottom and top, middle top, distal top and bottom, middle.
        constexpr std::array<double, 6> kAngles = {-2.356, 2.356, 1.571, 0.785, -0.785, -1.571};
        ring.push_back(builder_.Add(center + t * along - radius * std::cos(kAngles[k]) * across +
                                    radius * std::sin(kAngles[k]) * up));
      }
      builder_.Bridge(inner, ring, true);
      inner = ring;
    }
    builder_.Cap({inner[1], inner[2], inner[3], inner[4], inner[5], inner[0]}, 2, 1,
                 Vector3d::Zero());
  }

  const BodyShape& shape_;
  const Proportions& proportions_;
  CageBuilder builder_;
  BodyCage cage_;
  std::vector<Ring> trunk_;
};

}  // namespace

BodyCage BuildBodyCage(const BodyShape& shape) { return BodyCageMaker(shape).Make(); }

}  // namespace capfit::mannequin
