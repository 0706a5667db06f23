#include "core/character/find_character.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/character/callers_word.h"
#include "core/character/character_report.h"
#include "core/character/nearness.h"
#include "core/character/shell_facts.h"
#include "core/character/verdict.h"

namespace capfit::character {
namespace {

// What is worn close stays within this share of the height (up to three times it, see CellSet).
constexpr double kWornShare = 0.015;
// Pieces of one part, as those of a robot, that touch.
constexpr double kTouchShare = 0.004;
// The winding number around the space between the legs from which a shell is a skirt.
constexpr float kGoesBetweenLegs = 0.5F;
// Shares of the whole area: what is smaller is no clothing, hair or armour; what is larger is of
// the body.
constexpr double kSmallShare = 0.005;
constexpr double kLargeShare = 0.1;
// Of a shell's vertices: all but rims and a few loose threads.
constexpr double kNearlyAll = 0.9;
constexpr std::size_t kSamplesOfNearness = 500;

class Judge : private ShellFacts {
 public:
  Judge(const formats::PolygonSoup& soup, const CharacterOptions& options,
        const std::map<body::LandmarkId, Eigen::Vector3d>& joints, std::span<const char> is_floor,
        const ThreadPool& pool)
      : ShellFacts(soup, joints, is_floor, pool), options_(options) {}

  absl::StatusOr<Character> Run() {
    CAPFIT_RETURN_IF_ERROR(CheckNames(options_, parts_));
    if (count() > kMostShells) {
      return Refused(
          ErrorReason::kNoSurface,
          absl::StrCat("the mesh falls apart into ", count(), " pieces, at most ", kMostShells,
                       " are looked at: do neighbouring faces share "
                       "vertices?"));
    }
    CAPFIT_RETURN_IF_ERROR(FindWhatIsApart());
    if (points_) {
      JudgeByJoints();
    } else {
      JudgeByNames();
    }
    AddPiecesThatTouch();
    HearTheCaller(options_, parts_, shells_, verdicts_);
    return MakeCharacter(shells_, parts_, verdicts_, points_.has_value());
  }

 private:
  void JudgeByNames() {
    for (std::size_t s = 0; s < count(); ++s) {
      if (IsApart(s)) continue;
      const std::optional<PartKind> named = names_[shell(s).part];
      if (IsCrumb(s)) {
        verdicts_[s] = {PartKind::kInner, false, "small beside the rest of its part"};
      } else if (named) {
        verdicts_[s] = ByKind(*named, "by its name");
      } else if (part_area_[shell(s).part] < kSmallShare * area_) {
        verdicts_[s] = {PartKind::kInner, false, "small"};
      } else {
        verdicts_[s] = {PartKind::kBody, true, "hangs together with the body"};
      }
    }
    const auto taken = [](const Verdict& verdict) { return verdict.is_included; };
    if (std::any_of(verdicts_.begin(), verdicts_.end(), taken)) return;
    // Names alone never take everything away.
    for (std::size_t s = 0; s < count(); ++s) {
      if (!IsApart(s)) verdicts_[s] = {PartKind::kBody, true, "nothing else is there"};
    }
  }

  [[nodiscard]] Verdict ByKind(PartKind kind, std::string_view reason) const {
    switch (kind) {
      case PartKind::kBody:
      case PartKind::kClothing:
      case PartKind::kShoe:
        return {kind, true, reason};
      case PartKind::kHair:
        return {kind, options_.hair, options_.hair ? "hair, as asked for" : reason};
      case PartKind::kSkirt:
        return {kind, options_.skirt, options_.skirt ? "skirt, as asked for" : reason};
      default:
        return {kind, false, reason};
    }
  }

  void JudgeByJoints() {
    const std::optional<std::size_t> head = HeadShell();
    for (std::size_t s = 0; s < count(); ++s) {
      if (IsApart(s) || !(Carries(s) || head == s)) continue;
      is_carrier_.insert(s);
      const bool is_head = head == s;
      verdicts_[s] = is_head ? Verdict{KindOr(s, PartKind::kBody), true, "goes around the head"}
                             : CarriersVerdict(s);
      if (verdicts_[s].is_included) AddCells(s);
    }
    FindLargestCarriers();
    for (const std::size_t s : is_carrier_) {
      const bool is_skirt = verdicts_[s].kind == PartKind::kSkirt;
      if (head != s && !is_skirt && verdicts_[s].is_included && IsHeldOnly(s)) {
        verdicts_[s] = {PartKind::kAccessory, false, "held, and stands off the body"};
      }
    }
    FindWhatIsOnHead();
    for (std::size_t s = 0; s < count(); ++s) {
      if (IsApart(s) || is_carrier_.contains(s)) continue;
      verdicts_[s] = is_on_head_[shell(s).part] != 0 ? OnHeadVerdict(s) : OnBodyVerdict(s);
    }
  }

  // Of each inner point the largest carriers of two different parts.
  void FindLargestCarriers() {
    largest_carriers_.assign(points_->trunk.size() + points_->limbs.size(), {});
    for (const std::size_t s : is_carrier_) {
      for (const std::size_t point : carried_[s]) {
        auto& [first, second] = largest_carriers_[point];
        const Carrier own = {shell(s).part, shell(s).area};
        if (first.part == own.part) {
          first.area = std::max(first.area, own.area);
        } else if (own.area > first.area) {
          second = std::exchange(first, own);
        } else if (own.area > second.area) {
          second = own;
        }
      }
    }
    is_of_the_body_.assign(parts_.size(), 0);
    for (const auto& [first, second] : largest_carriers_) {
      if (first.area > 0.0 && second.area == 0.0) is_of_the_body_[first.part] = 1;
    }
    std::vector<double> carrying(parts_.size(), 0.0);
    for (const std::size_t s : is_carrier_) carrying[shell(s).part] += shell(s).area;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      if (carrying[part] > kLargeShare * area_) is_of_the_body_[part] = 1;
    }
  }

  void AddCells(std::size_t s) {
    CellSet& cells = cells_.try_emplace(shell(s).part, kWornShare * height_).first->second;
    for (std::size_t f = shells_.first_facet[s]; f < shells_.first_facet[s + 1]; ++f) {
      cells.Add(shells_.facets[f]);
    }
  }

  // What only goes around what other parts go around too, and whose part is not worn on them: a
  // sword's grip.
  [[nodiscard]] bool IsHeldOnly(std::size_t s) {
    const std::size_t part = shell(s).part;
    const auto is_anothers = [&](std::size_t point) {
      const auto larger = [&](const Carrier& c) {
        return c.part != part && c.area > shell(s).area;
      };
      return std::any_of(largest_carriers_[point].begin(), largest_carriers_[point].end(), larger);
    };
    return std::all_of(carried_[s].begin(), carried_[s].end(), is_anothers) && !IsPartWorn(part);
  }

  // A body's or a garment's name where it has one; others lie, for it goes around limbs.
  [[nodiscard]] PartKind KindOr(std::size_t s, PartKind otherwise) const {
    const std::optional<PartKind> named = names_[shell(s).part];
    const bool is_worn =
        named == PartKind::kBody || named == PartKind::kClothing || named == PartKind::kShoe;
    return is_worn ? *named : otherwise;
  }

  [[nodiscard]] Verdict CarriersVerdict(std::size_t s) const {
    if (between_legs_[s] < kGoesBetweenLegs) {
      return {KindOr(s, PartKind::kBody), true, "goes around trunk or limbs"};
    }
    if (options_.skirt) return {PartKind::kSkirt, true, "skirt, as asked for"};
    if (CarriesAlone(s)) return {PartKind::kSkirt, true, "a skirt, but nothing else is the trunk"};
    return {PartKind::kSkirt, false, "goes around the space between the legs"};
  }

  // Whether the trunk is lost without it, as under a robe.
  [[nodiscard]] bool CarriesAlone(std::size_t s) const {
    if (!CarriesTrunk(s)) return false;
    for (std::size_t other = 0; other < count(); ++other) {
      if (other != s && CarriesTrunk(other) && between_legs_[other] < kGoesBetweenLegs) {
        return false;
      }
    }
    return true;
  }

  // The one that goes around the head, where no carrier of the trunk does.
  [[nodiscard]] std::optional<std::size_t> HeadShell() const {
    std::optional<std::size_t> best;
    for (std::size_t s = 0; s < count(); ++s) {
      if (IsApart(s) || around_head_[s] < 0.5F * kGoesAround) continue;
      if (Carries(s) && around_head_[s] >= kGoesAround) return std::nullopt;
      if (!Carries(s) && (!best || around_head_[s] > around_head_[*best])) best = s;
    }
    return best;
  }

  // By part, of the facets of shells that carry nothing, how many lie above the neck: long hair
  // hangs below it, but not most of it.
  void FindWhatIsOnHead() {
    std::vector<std::array<std::size_t, 2>> facets(parts_.size(), {0, 0});
    for (std::size_t s = 0; s < count(); ++s) {
      if (IsApart(s) || is_carrier_.contains(s)) continue;
      for (std::size_t f = shells_.first_facet[s]; f < shells_.first_facet[s + 1]; ++f) {
        const Eigen::Vector3d from_neck = shells_.facets[f].Middle() - points_->neck;
        facets[shell(s).part][points_->up.dot(from_neck) > 0.0 ? 1 : 0] += 1;
      }
    }
    for (const auto& [below, above] : facets) is_on_head_.push_back(above > below ? 1 : 0);
  }

  [[nodiscard]] Verdict OnHeadVerdict(std::size_t s) const {
    const std::optional<PartKind> named = names_[shell(s).part];
    if (named && *named != PartKind::kClothing && *named != PartKind::kBody) {
      return ByKind(*named, "on the head, by its name");
    }
    if (part_area_[shell(s).part] < kSmallShare * area_ || IsCrumb(s)) {
      return {PartKind::kInner, false, "small and on the head"};
    }
    return ByKind(PartKind::kHair, "on the head without going around it");
  }

  [[nodiscard]] Verdict OnBodyVerdict(std::size_t s) {
    const std::optional<PartKind> named = names_[shell(s).part];
    const bool is_worn = !named || *named == PartKind::kBody || *named == PartKind::kClothing ||
                         *named == PartKind::kShoe;
    if (!is_worn) return ByKind(*named, "by its name");
    if (IsCrumb(s)) return {PartKind::kInner, false, "small beside the rest of its part"};
    if (!IsPartWorn(shell(s).part)) return {PartKind::kAccessory, false, "stands off the body"};
    if (named || part_area_[shell(s).part] >= kSmallShare * area_) {
      return {KindOr(s, PartKind::kClothing), true, "worn close to the body"};
    }
    return {PartKind::kAccessory, false, "small and around no limb"};
  }

  // Whether the part as a whole, bags with their straps, lies close to the carriers of the others;
  // pieces of a robot, which nothing else could stand for, to those of their own part.
  [[nodiscard]] bool IsPartWorn(std::size_t part) {
    is_worn_part_.resize(parts_.size(), 0);
    if (is_worn_part_[part] == 0) is_worn_part_[part] = LiesClose(part) ? 2 : 1;
    return is_worn_part_[part] == 2;
  }

  [[nodiscard]] bool LiesClose(std::size_t part) const {
    std::size_t facets = 0;
    for (const std::size_t s : shells_of_part_[part]) facets += FacetCount(s);
    const std::size_t step = std::max<std::size_t>(1, facets / kSamplesOfNearness);
    std::size_t near = 0;
    std::size_t all = 0;
    for (const std::size_t s : shells_of_part_[part]) {
      for (std::size_t f = shells_.first_facet[s]; f < shells_.first_facet[s + 1]; f += step) {
        near += IsNearAnother(part, shells_.facets[f].Middle()) ? 1 : 0;
        ++all;
      }
    }
    const double enough = is_of_the_body_[part] != 0 ? 0.5 : kNearlyAll;
    return static_cast<double>(near) >= enough * static_cast<double>(all);
  }

  [[nodiscard]] std::size_t FacetCount(std::size_t s) const {
    return shells_.first_facet[s + 1] - shells_.first_facet[s];
  }

  [[nodiscard]] bool IsNearAnother(std::size_t part, const Eigen::Vector3d& point) const {
    return std::any_of(cells_.begin(), cells_.end(), [&](const auto& entry) {
      return (entry.first != part || is_of_the_body_[part] != 0) && entry.second.IsNear(point);
    });
  }

  // Pieces of a part that is mostly taken, which touch what is taken: fingers of a robot, soles.
  void AddPiecesThatTouch() {
    std::vector<double> taken_area(parts_.size(), 0.0);
    std::vector<char> taken(count(), 0);
    for (std::size_t s = 0; s < count(); ++s) {
      if (verdicts_[s].is_included) taken_area[shell(s).part] += shell(s).area;
    }
    std::set<std::uint32_t> surfaces;
    for (std::size_t s = 0; s < count(); ++s) {
      if (verdicts_[s].is_included) surfaces.insert(shell(s).surface);
    }
    bool is_any = false;
    for (std::size_t s = 0; s < count(); ++s) {
      const std::size_t part = shell(s).part;
      // For crumbs alone, as the eyeballs of a body, no surface that is one is given up.
      const bool may_join =
          !verdicts_[s].is_included && !IsApart(s) && (surfaces.size() > 1 || !IsCrumb(s)) &&
          verdicts_[s].kind != PartKind::kSkirt && taken_area[part] > 0.5 * part_area_[part];
      is_any = is_any || may_join;
      taken[s] = verdicts_[s].is_included || may_join ? 1 : 0;
    }
    if (!is_any) return;
    const std::vector<std::uint32_t> touching = ClustersOf(shells_, kTouchShare * height_, taken);
    std::set<std::uint32_t> held;
    for (std::size_t s = 0; s < count(); ++s) {
      if (verdicts_[s].is_included) held.insert(touching[s]);
    }
    for (std::size_t s = 0; s < count(); ++s) {
      if (taken[s] != 0 && !verdicts_[s].is_included && held.contains(touching[s])) {
        verdicts_[s] = {KindOr(s, PartKind::kBody), true, "touches the rest of its part"};
      }
    }
  }

  const CharacterOptions& options_;
  std::vector<char> is_worn_part_;  // 0: not asked yet, 1: no, 2: yes
  struct Carrier {
    std::size_t part = static_cast<std::size_t>(-1);
    double area = 0.0;
  };
  std::vector<std::array<Carrier, 2>> largest_carriers_;  // by inner point
  // By part: whether it alone goes around some inner point, or much of it goes around some.
  std::vector<char> is_of_the_body_;
  std::set<std::size_t> is_carrier_;
  std::map<std::size_t, CellSet> cells_;  // of carriers that are taken, by part
  std::vector<char> is_on_head_;          // by part
};

}  // namespace

absl::StatusOr<Character> FindCharacter(const formats::PolygonSoup& soup,
                                        const CharacterOptions& options,
                                        const std::map<body::LandmarkId, Eigen::Vector3d>& joints,
                                        const ThreadPool& pool, std::span<const char> is_floor) {
  return Judge(soup, options, joints, is_floor, pool).Run();
}

}  // namespace capfit::character
