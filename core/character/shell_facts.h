// What the shells of a file are, before it is judged which of them are the character.
#ifndef CAPFIT_CORE_CHARACTER_SHELL_FACTS_H_
#define CAPFIT_CORE_CHARACTER_SHELL_FACTS_H_

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/base/thread_pool.h"
#include "core/body/anatomy.h"
#include "core/character/part_words.h"
#include "core/character/shells.h"
#include "core/character/surrounding.h"
#include "core/character/verdict.h"
#include "core/formats/polygon_soup.h"

namespace capfit::character {

// More pieces are not looked at: then a file has lost its shared vertices, or is no avatar; hair of
// cards has some thousands.
inline constexpr std::size_t kMostShells = 20'000;

// Winding numbers from which a shell goes around a point; a scalp or a hat has less than half.
inline constexpr float kGoesAround = 0.6F;

// Shells with their sizes, what they go around, and what of them lies apart. A base for who judges.
class ShellFacts {
 public:
  // `joints`: of the skeleton, may be empty; then no shell goes around anything. `is_floor`: by
  // face, what was cut off as a floor. O(facets * points) for what they go around.
  ShellFacts(const formats::PolygonSoup& soup,
             const std::map<body::LandmarkId, Eigen::Vector3d>& joints,
             std::span<const char> is_floor, const ThreadPool& pool);

 protected:
  [[nodiscard]] std::size_t count() const { return shells_.shells.size(); }
  [[nodiscard]] const Shell& shell(std::size_t s) const { return shells_.shells[s]; }

  // Finds what lies apart from the body, and judges it. TWO_BODIES where another group of shells is
  // as large as a person.
  absl::Status FindWhatIsApart();
  // Not part of what hangs together with the body. After FindWhatIsApart.
  [[nodiscard]] bool IsApart(std::size_t s) const;
  // Small beside the one that nearly all of its part is.
  [[nodiscard]] bool IsCrumb(std::size_t s) const;
  // Goes around trunk or limbs; around the trunk. (The trunk's points come first.)
  [[nodiscard]] bool Carries(std::size_t s) const { return points_ && !carried_[s].empty(); }
  [[nodiscard]] bool CarriesTrunk(std::size_t s) const {
    return Carries(s) && carried_[s].front() < points_->trunk.size();
  }

  Shells shells_;
  std::vector<formats::SoupPart> parts_;  // at least one
  std::vector<std::optional<PartKind>> names_;
  std::vector<double> part_area_;
  std::vector<double> largest_of_part_;
  std::vector<std::vector<std::size_t>> shells_of_part_;  // what hangs together with the body
  std::optional<InnerPoints> points_;
  double area_ = 0.0;
  double height_ = 0.0;
  // By shell.
  std::vector<Verdict> verdicts_;
  std::vector<std::vector<std::size_t>> carried_;  // the inner points that it goes around
  std::vector<float> around_head_;
  std::vector<float> between_legs_;

 private:
  void MeasureSpread();
  void Surround(const ThreadPool& pool);
  void FindSheets();
  [[nodiscard]] Eigen::Vector3d SpreadOf(std::size_t s) const;
  absl::Status FindGroups();
  void MeasureParts();
  [[nodiscard]] std::string NameOf(std::size_t s) const;

  std::vector<char> is_sheet_;
  std::vector<std::uint32_t> group_;
  std::uint32_t main_ = 0;  // the body's group
};

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_SHELL_FACTS_H_
