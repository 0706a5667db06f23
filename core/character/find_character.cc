#include "core/character/find_character.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status.h"
#include "core/character/callers_word.h"
#include "core/character/character_report.h"
#include "core/character/nearness.h"
#include "core/character/shells.h"
#include "core/character/surrounding.h"
#include "core/character/verdict.h"
#include "core/formats/file_error.h"

namespace capfit::character {
namespace {

// The height of a standing body over the standard deviation of its surface; between 3 and 4.
constexpr double kHeightOfSpread = 3.6;
// Shares of the height. Gaps between the parts of one character stay below the first; what is worn
// close stays within the second (up to three times it, see CellSet).
constexpr double kGapShare = 0.02;
constexpr double kWornShare = 0.015;
// Pieces of one part, as those of a robot, that touch.
constexpr double kTouchShare = 0.004;
// A floor: thinner than the first by its standard deviation, wider than the second.
constexpr double kSheetThickness = 0.01;
constexpr double kSheetWidth = 0.1;

// Winding numbers from which a shell goes around a point; a scalp or a hat has less than half.
constexpr float kGoesAround = 0.6F;
constexpr float kGoesAroundPartly = 0.15F;
constexpr float kGoesBetweenLegs = 0.5F;

// Shares of the whole area: what is smaller is no clothing, hair or armour; and what makes up
// nearly all of its part is the part.
constexpr double kSmallShare = 0.005;
constexpr double kLargeShare = 0.1;
constexpr double kWholePart = 0.85;
// A group of shells this large beside the largest (box, area) is another person.
constexpr double kPersonsBox = 0.6;
constexpr double kPersonsArea = 0.3;
// Of a shell's vertices: all but rims and a few loose threads.
constexpr double kNearlyAll = 0.9;
constexpr std::size_t kSamplesOfNearness = 500;
// Beyond it a file has lost its shared vertices, or is no avatar; hair of cards has some thousands.
constexpr std::size_t kMostShells = 20'000;

class Judge {
 public:
  Judge(const formats::PolygonSoup& soup, const CharacterOptions& options,
        const std::map<body::LandmarkId, Eigen::Vector3d>& joints, std::span<const char> is_floor,
        const ThreadPool& pool)
      : options_(options), shells_(FindShells(soup, is_floor)) {
    verdicts_.resize(shells_.shells.size());
    parts_ = soup.parts;
    if (parts_.empty()) parts_.push_back({"", "", 0, soup.face_count(), -1});
    points_ = InnerPointsOf(joints);
    for (const formats::SoupPart& part : parts_) {
      const std::optional<PartKind> kind = KindFromName(part.name);
      names_.push_back(kind ? kind : KindFromName(part.material));
    }
    MeasureSpread();
    if (points_ && count() <= kMostShells) Surround(pool);
  }

  absl::StatusOr<Character> Run() {
    CAPFIT_RETURN_IF_ERROR(CheckNames(options_, parts_));
    if (count() > kMostShells) {
      return Refused(
          ErrorReason::kNoSurface,
          absl::StrCat("the mesh falls apart into ", count(), " pieces, at most ", kMostShells,
                       " are looked at: do neighbouring faces share "
                       "vertices?"));
    }
    FindSheets();
    CAPFIT_RETURN_IF_ERROR(FindGroups());
    MeasureParts();
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
  [[nodiscard]] std::size_t count() const { return shells_.shells.size(); }
  [[nodiscard]] const Shell& shell(std::size_t s) const { return shells_.shells[s]; }

  // ---- what is measured

  // Area, middle and spread of all shells; the height that they speak for.
  void MeasureSpread() {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Facet& facet : shells_.facets) {
      const double area = facet.AreaVector().norm();
      area_ += area;
      sum += area * facet.Middle();
    }
    const Eigen::Vector3d middle = area_ > 0.0 ? Eigen::Vector3d(sum / area_) : sum;
    double squares = 0.0;
    for (const Facet& facet : shells_.facets) {
      squares += facet.AreaVector().norm() * facet.SecondMoment(middle).trace();
    }
    height_ = area_ > 0.0 ? kHeightOfSpread * std::sqrt(squares / area_) : 0.0;
    if (points_) height_ = points_->height;
  }

  // Of what hangs together with the body.
  void MeasureParts() {
    part_area_.assign(parts_.size(), 0.0);
    largest_of_part_.assign(parts_.size(), 0.0);
    shells_of_part_.assign(parts_.size(), {});
    for (std::size_t s = 0; s < count(); ++s) {
      if (IsApart(s)) continue;
      shells_of_part_[shell(s).part].push_back(s);
      part_area_[shell(s).part] += shell(s).area;
      largest_of_part_[shell(s).part] = std::max(largest_of_part_[shell(s).part], shell(s).area);
    }
  }

  void Surround(const ThreadPool& pool) {
    std::vector<Eigen::Vector3d> points = points_->trunk;
    for (const auto* more : {&points_->limbs, &points_->head, &points_->between_legs}) {
      points.insert(points.end(), more->begin(), more->end());
    }
    const std::size_t carried_points = points_->trunk.size() + points_->limbs.size();
    const std::vector<std::vector<float>> windings = WindingNumbers(shells_, points, pool);
    // Of all shells of the part together: shirts are sewn from a front and a back.
    std::vector<std::vector<float>> of_part(parts_.size(),
                                            std::vector<float>(carried_points, 0.0F));
    for (std::size_t s = 0; s < count(); ++s) {
      std::vector<float>& sum = of_part[shell(s).part];
      for (std::size_t p = 0; p < carried_points; ++p) sum[p] += windings[s][p];
    }
    carried_.assign(count(), {});
    for (std::size_t s = 0; s < count(); ++s) {
      for (std::size_t p = 0; p < carried_points; ++p) {
        const float own = windings[s][p];
        if (own >= kGoesAround ||
            (own >= kGoesAroundPartly && of_part[shell(s).part][p] >= kGoesAround)) {
          carried_[s].push_back(p);
        }
      }
    }
    for (const std::vector<float>& w : windings) {
      const auto head = w.begin() + static_cast<std::ptrdiff_t>(carried_points);
      const auto legs = head + static_cast<std::ptrdiff_t>(points_->head.size());
      around_head_.push_back(head == legs ? 0.0F : *std::max_element(head, legs));
      between_legs_.push_back(legs == w.end() ? 0.0F : *std::min_element(legs, w.end()));
    }
  }

  // ---- what lies apart

  // Thin and wide in all: a floor. Those that carry a limb are none.
  void FindSheets() {
    is_sheet_.assign(count(), 0);
    for (std::size_t s = 0; s < count(); ++s) {
      if (shell(s).is_cut_off) {
        is_sheet_[s] = 1;
        verdicts_[s] = {PartKind::kFragment, false, "floor or stand"};
      }
      if (Carries(s) || shell(s).area < kSheetWidth * kSheetWidth * height_ * height_) continue;
      const Eigen::Vector3d spread = SpreadOf(s);
      if (spread[0] > kSheetThickness * height_ || spread[1] < kSheetWidth * height_) continue;
      is_sheet_[s] = 1;
      verdicts_[s] = {PartKind::kFragment, false, "a flat sheet, as a floor"};
    }
  }

  // Standard deviations of the surface along its own axes, ascending.
  [[nodiscard]] Eigen::Vector3d SpreadOf(std::size_t s) const {
    const Eigen::Vector3d origin = 0.5 * (shell(s).box_min + shell(s).box_max);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (std::size_t f = shells_.first_facet[s]; f < shells_.first_facet[s + 1]; ++f) {
      const double area = shells_.facets[f].AreaVector().norm();
      sum += area * (shells_.facets[f].Middle() - origin);
      squares += area * shells_.facets[f].SecondMoment(origin);
    }
    const Eigen::Vector3d mean = sum / shell(s).area;
    const Eigen::Matrix3d covariance = squares / shell(s).area - mean * mean.transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .cwiseMax(0.0)
        .cwiseSqrt();
  }

  struct Group {
    std::size_t carried = 0;  // inner points that its shells go around
    double area = 0.0;
    Eigen::Vector3d box_min = Eigen::Vector3d::Constant(1e300);
    Eigen::Vector3d box_max = Eigen::Vector3d::Constant(-1e300);
    std::size_t largest_shell = 0;

    [[nodiscard]] double diagonal() const { return (box_max - box_min).norm(); }
  };

  absl::Status FindGroups() {
    if (!(height_ > 0.0)) return absl::OkStatus();
    std::vector<char> taken(count());
    for (std::size_t s = 0; s < count(); ++s) taken[s] = is_sheet_[s] == 0 ? 1 : 0;
    group_ = ClustersOf(shells_, kGapShare * height_, taken);
    std::vector<Group> groups(count());
    for (std::size_t s = 0; s < count(); ++s) {
      if (is_sheet_[s] != 0) continue;
      Group& group = groups[group_[s]];
      if (group.area == 0.0 || shell(s).area > shell(group.largest_shell).area) {
        group.largest_shell = s;
      }
      group.area += shell(s).area;
      if (points_) group.carried += carried_[s].size();
      group.box_min = group.box_min.cwiseMin(shell(s).box_min);
      group.box_max = group.box_max.cwiseMax(shell(s).box_max);
    }
    // The body's own group, where joints tell it, may be smaller than what stands beside it.
    const auto is_less = [](const Group& a, const Group& b) {
      return std::pair(a.carried, a.area) < std::pair(b.carried, b.area);
    };
    main_ = static_cast<std::uint32_t>(std::max_element(groups.begin(), groups.end(), is_less) -
                                       groups.begin());
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
      if (g == main_ || groups[g].area < kPersonsArea * groups[main_].area) continue;
      if (groups[g].diagonal() < kPersonsBox * groups[main_].diagonal()) continue;
      return Refused(
          ErrorReason::kTwoBodies,
          absl::StrFormat("two separate bodies: %s and %s (%.0f %% of its area); send "
                          "one body, or exclude the parts of the other",
                          NameOf(groups[main_].largest_shell), NameOf(groups[g].largest_shell),
                          100.0 * groups[g].area / groups[main_].area));
    }
    for (std::size_t s = 0; s < count(); ++s) {
      if (is_sheet_[s] == 0 && IsApart(s)) {
        verdicts_[s] = {PartKind::kFragment, false, "apart from the body"};
      }
    }
    return absl::OkStatus();
  }

  [[nodiscard]] std::string NameOf(std::size_t s) const {
    const std::string& name = parts_[shell(s).part].name;
    if (!name.empty()) return absl::StrCat("\"", formats::Printable(name, kLongestNameTold), "\"");
    const Eigen::Vector3d middle = 0.5 * (shell(s).box_min + shell(s).box_max);
    return absl::StrFormat("%d faces around (%.4g, %.4g, %.4g)", shell(s).face_count, middle.x(),
                           middle.y(), middle.z());
  }

  [[nodiscard]] bool IsApart(std::size_t s) const {
    // What goes around the body's limbs is never apart: a wide skirt.
    return is_sheet_[s] != 0 || (!group_.empty() && group_[s] != main_ && !Carries(s));
  }

  // ---- verdicts

  [[nodiscard]] bool IsCrumb(std::size_t s) const {
    const std::size_t part = shell(s).part;
    return shell(s).area < largest_of_part_[part] &&
           largest_of_part_[part] > kWholePart * part_area_[part];
  }

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

  [[nodiscard]] bool Carries(std::size_t s) const { return points_ && !carried_[s].empty(); }
  // (The trunk's points come first.)
  [[nodiscard]] bool CarriesTrunk(std::size_t s) const {
    return Carries(s) && carried_[s].front() < points_->trunk.size();
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
      // For crumbs alone, as the eyeballs of a body, nobody gives up a surface that is one.
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
  Shells shells_;
  std::vector<formats::SoupPart> parts_;  // at least one
  std::vector<std::optional<PartKind>> names_;
  std::vector<double> part_area_;
  std::vector<double> largest_of_part_;
  std::vector<std::vector<std::size_t>> shells_of_part_;  // what hangs together with the body
  std::vector<char> is_worn_part_;                        // 0: not asked yet, 1: no, 2: yes
  std::optional<InnerPoints> points_;
  double area_ = 0.0;
  double height_ = 0.0;
  // By shell.
  std::vector<Verdict> verdicts_;
  std::vector<char> is_sheet_;
  std::vector<std::uint32_t> group_;
  std::uint32_t main_ = 0;
  struct Carrier {
    std::size_t part = static_cast<std::size_t>(-1);
    double area = 0.0;
  };
  std::vector<std::array<Carrier, 2>> largest_carriers_;  // by inner point
  // By part: whether it alone goes around some inner point, or much of it goes around some.
  std::vector<char> is_of_the_body_;
  std::vector<std::vector<std::size_t>> carried_;  // the inner points that it goes around
  std::vector<float> around_head_;
  std::vector<float> between_legs_;
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
