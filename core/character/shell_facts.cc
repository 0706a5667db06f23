#include "core/character/shell_facts.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status.h"
#include "core/character/character_report.h"
#include "core/character/nearness.h"
#include "core/formats/file_error.h"

namespace capfit::character {
namespace {

// The height of a standing body over the standard deviation of its surface; between 3 and 4.
constexpr double kHeightOfSpread = 3.6;
// Of the height: gaps between the parts of one character stay below.
constexpr double kGapShare = 0.02;
// A floor: thinner than the first by its standard deviation, wider than the second.
constexpr double kSheetThickness = 0.01;
constexpr double kSheetWidth = 0.1;
// With this winding number a shell goes around a point together with others of its part.
constexpr float kGoesAroundPartly = 0.15F;
// Of a part's area: what makes up so much of it is the part.
constexpr double kWholePart = 0.85;
// A group of shells this large beside the largest (box, area) is another person.
constexpr double kPersonsBox = 0.6;
constexpr double kPersonsArea = 0.3;

struct Group {
  std::size_t carried = 0;  // inner points that its shells go around
  double area = 0.0;
  Eigen::Vector3d box_min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d box_max = Eigen::Vector3d::Constant(-1e300);
  std::size_t largest_shell = 0;

  [[nodiscard]] double diagonal() const { return (box_max - box_min).norm(); }
};

}  // namespace

ShellFacts::ShellFacts(const formats::PolygonSoup& soup,
                       const std::map<body::LandmarkId, Eigen::Vector3d>& joints,
                       std::span<const char> is_floor, const ThreadPool& pool)
    : shells_(FindShells(soup, is_floor)) {
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

absl::Status ShellFacts::FindWhatIsApart() {
  FindSheets();
  CAPFIT_RETURN_IF_ERROR(FindGroups());
  MeasureParts();
  return absl::OkStatus();
}

// Area, middle and spread of all shells; the height that they speak for.
void ShellFacts::MeasureSpread() {
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
void ShellFacts::MeasureParts() {
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

void ShellFacts::Surround(const ThreadPool& pool) {
  std::vector<Eigen::Vector3d> points = points_->trunk;
  for (const auto* more : {&points_->limbs, &points_->head, &points_->between_legs}) {
    points.insert(points.end(), more->begin(), more->end());
  }
  const std::size_t carried_points = points_->trunk.size() + points_->limbs.size();
  const std::vector<std::vector<float>> windings = WindingNumbers(shells_, points, pool);
  // Of all shells of the part together: shirts are sewn from a front and a back.
  std::vector<std::vector<float>> of_part(parts_.size(), std::vector<float>(carried_points, 0.0F));
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

// Thin and wide in all: a floor. Those that carry a limb are none.
void ShellFacts::FindSheets() {
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
Eigen::Vector3d ShellFacts::SpreadOf(std::size_t s) const {
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

absl::Status ShellFacts::FindGroups() {
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

std::string ShellFacts::NameOf(std::size_t s) const {
  const std::string& name = parts_[shell(s).part].name;
  if (!name.empty()) return absl::StrCat("\"", formats::Printable(name, kLongestNameTold), "\"");
  const Eigen::Vector3d middle = 0.5 * (shell(s).box_min + shell(s).box_max);
  return absl::StrFormat("%d faces around (%.4g, %.4g, %.4g)", shell(s).face_count, middle.x(),
                         middle.y(), middle.z());
}

bool ShellFacts::IsApart(std::size_t s) const {
  // What goes around the body's limbs is never apart: a wide skirt.
  return is_sheet_[s] != 0 || (!group_.empty() && group_[s] != main_ && !Carries(s));
}

bool ShellFacts::IsCrumb(std::size_t s) const {
  const std::size_t part = shell(s).part;
  return shell(s).area < largest_of_part_[part] &&
         largest_of_part_[part] > kWholePart * part_area_[part];
}

}  // namespace capfit::character
