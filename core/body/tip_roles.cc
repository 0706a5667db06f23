#include "core/body/tip_roles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/enum_index.h"

namespace capfit::body {
namespace {

// Ways along the surface between two tips, half-way between bodies with and without head, hands
// and feet. Only their ratios count.
constexpr double kHandToHand = 0.65;
constexpr double kHeadToHand = 0.48;
constexpr double kHeadToFoot = 1.05;
constexpr double kHandToFoot = 1.20;
constexpr double kFootToFoot = 1.20;
// Both arms are about as long as each other, both legs too: weight of the log of the ratio.
constexpr double kUnequalPairCost = 0.5;
// What it costs to leave a role empty, or a tip without a role, in units of the misfit.
constexpr double kEmptyRoleCost = 0.12;
constexpr double kUnusedTipCost = 0.10;
// What it costs to take an arm, a leg or both legs for cut off, or all below the trunk: less than
// to leave a role empty and its tip without one.
constexpr double kCutCost = 0.16;
// Of less no limb can be made: it has not sections enough. In units of the square root of the area.
constexpr double kShortestCutArm = 0.10;
constexpr double kShortestCutLeg = 0.20;
// What is left of the thighs of an upper body needs no role.
constexpr double kLongestStub = 0.30;
// What is longer, beside head and arms, speaks against it.
constexpr double kLimbBesideCost = 0.40;
// Two stubs that join the head this much before what would be the arms are those of arms.
constexpr double kClearlyBefore = 0.05;
// A role for a tip that the skeleton gives to another: more than leaving both without.
constexpr double kContradictionCost = 0.40;

// Mean girth of head, arm and leg, and the weight of the log of the ratio.
constexpr double kHeadGirth = 0.45;
constexpr double kArmGirth = 0.18;
constexpr double kLegGirth = 0.31;
constexpr double kGirthCost = 0.25;

bool HoldsAny(const TipCandidate& candidate) {
  return std::any_of(candidate.holds.begin(), candidate.holds.end(), [](bool b) { return b; });
}

double UsualWay(Tip a, Tip b) {
  const auto is_hand = [](Tip t) { return t == Tip::kHandA || t == Tip::kHandB; };
  if (a > b) std::swap(a, b);
  if (a == Tip::kHead) return is_hand(b) ? kHeadToHand : kHeadToFoot;
  if (is_hand(a)) return is_hand(b) ? kHandToHand : kHandToFoot;
  return kFootToFoot;
}

double UsualGirth(Tip tip) {
  if (tip == Tip::kHead) return kHeadGirth;
  return tip == Tip::kHandA || tip == Tip::kHandB ? kArmGirth : kLegGirth;
}

using Roles = std::array<int, kTipCount>;  // candidate of each role, -1: none

// Which roles are held by limbs that are cut off somewhere, so that their lengths tell nothing.
using CutRoles = std::array<bool, kTipCount>;

// Gives the roles to the tips so that the proportions fit best.
class RoleFinder {
 public:
  RoleFinder(std::span<const Branch> branches, std::span<const TipCandidate> candidates,
             const std::optional<RigEnds>& rig, Cut cut)
      : branches_(branches), candidates_(candidates), rig_(rig), cut_(cut) {}

  // Tries every way; equal roles (two hands) count once.
  TipRoles Run() {
    TryFrom(0);
    return {best_, best_cut_[Index(Tip::kFootA)] && best_cut_[Index(Tip::kFootB)], best_misfit_};
  }

 private:
  void TryFrom(int role) {
    const bool is_upper_body = cut_ == Cut::kUpperBody;
    if (role == (is_upper_body ? static_cast<int>(Tip::kFootA) : kTipCount)) {
      if (CostOfGaps() >= best_misfit_) return;  // the rest only adds to it
      Offer({});
      if (cut_ != Cut::kLimbs) return;
      for (const CutRoles& cut : CutsToTry()) Offer(cut);
      return;
    }
    const bool is_second =
        role == static_cast<int>(Tip::kHandB) || role == static_cast<int>(Tip::kFootB);
    const bool first_is_empty = is_second && roles_[role - 1] < 0;
    const int first = is_second ? roles_[role - 1] + 1 : 0;
    const int count = static_cast<int>(candidates_.size());
    for (int tip = first; tip < count && !first_is_empty; ++tip) {
      if (std::find(roles_.begin(), roles_.begin() + role, tip) != roles_.begin() + role) continue;
      if (candidates_[tip].is_stump && (is_upper_body || role != static_cast<int>(Tip::kHead)))
        continue;
      roles_[role] = tip;
      TryFrom(role + 1);
    }
    roles_[role] = -1;
    if (!is_upper_body) TryFrom(role + 1);
  }

  void Offer(const CutRoles& cut) {
    // The area of an upper body does not tell its size, so that its ways have to.
    const bool is_upper_body = cut_ == Cut::kUpperBody;
    if (is_upper_body && HasStubsOfArms()) return;
    double misfit = CostBesideWays(cut);
    if (!is_upper_body) misfit += kGirthCost * GirthDeviation(1.0);
    if (misfit >= best_misfit_) return;
    const Ways ways = WaysBetween(cut);
    misfit += ways.deviation;
    if (is_upper_body) misfit += kGirthCost * GirthDeviation(std::exp(ways.mean_log));
    if (misfit >= best_misfit_) return;
    best_misfit_ = misfit;
    best_ = roles_;
    best_cut_ = cut;
  }

  // The shorter arm, the shorter leg, both legs. More at a time would let any tips stand for
  // anything.
  [[nodiscard]] std::vector<CutRoles> CutsToTry() const {
    std::vector<CutRoles> cuts;
    for (const Tip first : {Tip::kHandA, Tip::kFootA}) {
      const std::optional<int> shorter = ShorterOfPair(static_cast<int>(first));
      if (!shorter) continue;
      cuts.emplace_back()[*shorter] = true;
      if (first == Tip::kFootA) cuts.push_back({false, false, false, true, true});
    }
    return cuts;
  }

  // Of the roles `first` and the next, where both are held by what is long enough.
  [[nodiscard]] std::optional<int> ShorterOfPair(int first) const {
    if (roles_[first] < 0 || roles_[first + 1] < 0) return std::nullopt;
    const int shorter = TipDistance(first) < TipDistance(first + 1) ? first : first + 1;
    const double length = TipDistance(shorter) - Junction(first, first + 1);
    const bool is_arm = first == static_cast<int>(Tip::kHandA);
    if (length < (is_arm ? kShortestCutArm : kShortestCutLeg)) return std::nullopt;
    return shorter;
  }

  [[nodiscard]] double Junction(int role_a, int role_b) const {
    return JunctionLevel(branches_, candidates_[roles_[role_a]].branch,
                         candidates_[roles_[role_b]].branch);
  }
  [[nodiscard]] double TipDistance(int role) const {
    return branches_[candidates_[roles_[role]].branch].tip_distance;
  }

  // |log(length / length)| of a pair of limbs, both counted from where they join; 0 where one of
  // them is cut.
  [[nodiscard]] double Inequality(Tip a, const CutRoles& cut) const {
    const int role_a = static_cast<int>(a);
    const int role_b = role_a + 1;
    if (roles_[role_a] < 0 || roles_[role_b] < 0 || cut[role_a] != cut[role_b]) return 0.0;
    const double level = Junction(role_a, role_b);
    return std::abs(std::log(std::max(TipDistance(role_a) - level, 1e-6) /
                             std::max(TipDistance(role_b) - level, 1e-6)));
  }

  // Mean and standard deviation of log(way / usual way) over all pairs of roles.
  struct Ways {
    double mean_log = 0.0;
    double deviation = 0.0;
  };

  [[nodiscard]] Ways WaysBetween(const CutRoles& cut) const {
    double sum = 0.0;
    double sum_of_squares = 0.0;
    int pairs = 0;
    for (int i = 0; i < kTipCount; ++i) {
      for (int j = i + 1; j < kTipCount; ++j) {
        if (roles_[i] < 0 || roles_[j] < 0 || cut[i] || cut[j]) continue;
        const double way = TipDistance(i) + TipDistance(j) - 2.0 * Junction(i, j);
        const double deviation =
            std::log(std::max(way, 1e-6) / UsualWay(static_cast<Tip>(i), static_cast<Tip>(j)));
        sum += deviation;
        sum_of_squares += deviation * deviation;
        ++pairs;
      }
    }
    if (pairs == 0) return {};
    const double mean = sum / pairs;
    return {mean, std::sqrt(std::max(0.0, sum_of_squares / pairs - mean * mean))};
  }

  // Mean of |log(girth / usual girth)|, of a body that is larger than usual by `scale`.
  [[nodiscard]] double GirthDeviation(double scale) const {
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < kTipCount; ++i) {
      if (roles_[i] < 0) continue;
      sum += std::abs(std::log(std::max(candidates_[roles_[i]].girth, 1e-6) /
                               (scale * UsualGirth(static_cast<Tip>(i)))));
      ++count;
    }
    return count > 0 ? sum / count : 0.0;
  }

  [[nodiscard]] double LengthOf(const TipCandidate& candidate) const {
    return branches_[candidate.branch].tip_distance - candidate.junction;
  }

  // What may be left of a thigh.
  [[nodiscard]] bool IsStub(const TipCandidate& candidate) const {
    return cut_ == Cut::kUpperBody && !candidate.is_stump && LengthOf(candidate) < kLongestStub;
  }

  [[nodiscard]] bool IsUsed(int candidate) const {
    return std::find(roles_.begin(), roles_.end(), candidate) != roles_.end();
  }

  [[nodiscard]] std::vector<const TipCandidate*> Stubs() const {
    std::vector<const TipCandidate*> stubs;
    for (int c = 0; c < static_cast<int>(candidates_.size()); ++c) {
      if (IsStub(candidates_[c]) && !IsUsed(c)) stubs.push_back(&candidates_[c]);
    }
    return stubs;
  }

  // |log(length / length)| and of the girths, of two stubs: those of both thighs are alike, head
  // and thigh are not.
  [[nodiscard]] double InequalityOfStubs() const {
    const std::vector<const TipCandidate*> stubs = Stubs();
    if (stubs.size() != 2) return 0.0;
    const auto inequality = [](double a, double b) {
      return std::abs(std::log(std::max(a, 1e-6) / std::max(b, 1e-6)));
    };
    return inequality(LengthOf(*stubs[0]), LengthOf(*stubs[1])) +
           inequality(stubs[0]->girth, stubs[1]->girth);
  }

  // Both legs would be arms then.
  [[nodiscard]] bool HasStubsOfArms() const {
    const std::vector<const TipCandidate*> stubs = Stubs();
    const double arms = Junction(Index(Tip::kHead), Index(Tip::kHandA));
    const auto joins_before = [&](const TipCandidate* stub) {
      const int head = candidates_[roles_[Index(Tip::kHead)]].branch;
      return JunctionLevel(branches_, head, stub->branch) > arms + kClearlyBefore;
    };
    return stubs.size() == 2 && std::all_of(stubs.begin(), stubs.end(), joins_before);
  }

  [[nodiscard]] int UnusedTips() const {
    int unused = 0;
    for (int c = 0; c < static_cast<int>(candidates_.size()); ++c) {
      if (candidates_[c].is_stump || IsStub(candidates_[c])) continue;
      if (rig_ && !HoldsAny(candidates_[c])) continue;
      if (!IsUsed(c)) ++unused;
    }
    return unused;
  }

  // Tips whose role the skeleton gives to others. Of a head that it does not know, all that it says
  // is that no hand or foot is one.
  [[nodiscard]] int Contradictions() const {
    int contradictions = 0;
    for (int role = 0; rig_ && role < kTipCount; ++role) {
      if (roles_[role] < 0) continue;
      const auto [first, last] = EndsOf(static_cast<Tip>(role));
      const TipCandidate& candidate = candidates_[roles_[role]];
      const bool holds_its_end = candidate.holds[Index(first)] || candidate.holds[Index(last)];
      const bool is_known = rig_->vertex[Index(first)].has_value();
      if (is_known ? !holds_its_end : HoldsAny(candidate)) ++contradictions;
    }
    return contradictions;
  }

  [[nodiscard]] double CostOfGaps() const {
    const int used =
        static_cast<int>(std::count_if(roles_.begin(), roles_.end(), [](int r) { return r >= 0; }));
    const bool is_upper_body = cut_ == Cut::kUpperBody;
    return (is_upper_body ? kCutCost : kEmptyRoleCost * (kTipCount - used)) +
           (is_upper_body ? kLimbBesideCost : kUnusedTipCost) * UnusedTips() +
           kContradictionCost * Contradictions();
  }

  [[nodiscard]] double CostBesideWays(const CutRoles& cut) const {
    const double inequality =
        Inequality(Tip::kHandA, cut) + Inequality(Tip::kFootA, cut) + InequalityOfStubs();
    return kUnequalPairCost * inequality + CostOfGaps() + (cut == CutRoles{} ? 0.0 : kCutCost);
  }

  std::span<const Branch> branches_;
  std::span<const TipCandidate> candidates_;
  const std::optional<RigEnds>& rig_;
  Cut cut_;
  Roles roles_ = {-1, -1, -1, -1, -1};
  Roles best_ = {-1, -1, -1, -1, -1};
  CutRoles best_cut_ = {};
  double best_misfit_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::pair<RigEnd, RigEnd> EndsOf(Tip tip) {
  if (tip == Tip::kHead) return {RigEnd::kHead, RigEnd::kHead};
  return tip == Tip::kHandA || tip == Tip::kHandB
             ? std::pair(RigEnd::kLeftHand, RigEnd::kRightHand)
             : std::pair(RigEnd::kLeftFoot, RigEnd::kRightFoot);
}

TipRoles FindTipRoles(std::span<const Branch> branches, std::span<const TipCandidate> candidates,
                      const std::optional<RigEnds>& rig, Cut cut) {
  return RoleFinder(branches, candidates, rig, cut).Run();
}

}  // namespace capfit::body
