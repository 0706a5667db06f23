// The rows of a penalty programme as its solver goes through them.
#ifndef CAPFIT_CORE_TIGHTEN_ROW_TABLE_H_
#define CAPFIT_CORE_TIGHTEN_ROW_TABLE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/short_loops.h"
#include "core/tighten/penalty_program.h"

namespace capfit::tighten {

// Rows in a lane of doubles and of floats, one vector register each.
inline constexpr Eigen::Index kDoublesInLane = 4;
inline constexpr Eigen::Index kFloatsInLane = 8;

// Which row of a programme.
struct RowPlace {
  std::uint32_t batch = 0;
  std::uint32_t row = 0;
};

// Rows that touch the same variables, [begin, end) of the table, a whole number of lanes.
struct RowGroup {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;
  int first_a = 0;
  int first_b = -1;
  std::size_t first_in_order = 0;  // and as many more as are not there to fill up the last lane
  std::size_t count = 0;
};

// Groups that one thread takes at a time, [begin, end).
struct RowPart {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// Which row goes where.
struct RowLayout {
  std::vector<RowPlace> order;  // group by group; in a group as the rows come in the programme
  std::vector<RowGroup> groups;
  std::vector<RowPart> parts;  // about as many rows in each; the same for any number of threads
  Eigen::Index size = 0;       // of the table
};

// `lane`: what groups are filled up to. O(rows + groups of variables^2).
[[nodiscard]] RowLayout LayOutRows(const PenaltyProgram& program, Eigen::Index lane);

// What is kept of a row beside its coefficients and its weight, which lie apart, as the solver goes
// through those alone many times.
enum class RowNumber {
  kValue,
  kPenalty,
  kT,  // the rest is the solver's own
  kS,
  kRow,
  kInverseRow,
  kInverseSlack,
  kSTarget,
  kShift,
  kDt,
  kDs,
  kDrow,
  kCount,
};

// So many rows as one vector register takes, to be read and written. Their numbers lie together, so
// that two addresses lead to all of them.
template <typename Real>
class RowLane {
 public:
  static constexpr Eigen::Index kRows = sizeof(Real) == 8 ? kDoublesInLane : kFloatsInLane;
  using Lane = Eigen::Array<Real, kRows, 1>;
  using Lanes = std::array<Lane, 8>;  // one for each coefficient of a row
  using Place = Eigen::Map<Lane>;

  static constexpr Eigen::Index kWeights = 9;  // coefficients and weight

  RowLane(Real* weights, Real* numbers) : weights_(weights), numbers_(numbers) {}

  Place coefficient(Eigen::Index c) const { return Place(weights_ + c * kRows); }
  Place weight() const { return coefficient(8); }
  Place value() const { return At(RowNumber::kValue); }
  Place penalty() const { return At(RowNumber::kPenalty); }
  Place t() const { return At(RowNumber::kT); }
  Place s() const { return At(RowNumber::kS); }
  Place row() const { return At(RowNumber::kRow); }
  Place inverse_row() const { return At(RowNumber::kInverseRow); }
  Place inverse_slack() const { return At(RowNumber::kInverseSlack); }
  Place s_target() const { return At(RowNumber::kSTarget); }
  Place shift() const { return At(RowNumber::kShift); }
  Place dt() const { return At(RowNumber::kDt); }
  Place ds() const { return At(RowNumber::kDs); }
  Place drow() const { return At(RowNumber::kDrow); }

  // Adds the rows times their weights.
  void AddWeighted(const Lane& weight, Lanes& sums) const {
    for (Eigen::Index c = 0; c < 8; ++c) sums[c] += weight * coefficient(c);
  }
  static Lanes NoLanes() {
    Lanes lanes;
    lanes.fill(Lane::Zero());
    return lanes;
  }

  // Of the rows with the variables that they touch.
  Lane Product(const std::array<Real, 8>& own) const {
    Lane product = Lane::Zero();
    for (Eigen::Index c = 0; c < 8; ++c) product += own[c] * coefficient(c);
    return product;
  }

 private:
  Place At(RowNumber number) const {
    return Place(numbers_ + static_cast<Eigen::Index>(number) * kRows);
  }

  Real* weights_;
  Real* numbers_;
};

// The rows with their coefficients apart, group by group, in doubles or floats. Groups are filled
// up to whole lanes with rows that never bind. Keeps its memory from programme to programme, so
// that the system need not hand it out and clear it each time.
template <typename Real>
class RowTable {
 public:
  static constexpr Eigen::Index kLane = RowLane<Real>::kRows;

  // `layout`: for lanes that are a multiple of kLane; must outlive its use here. What the solver
  // keeps has no value yet.
  void Take(const PenaltyProgram& program, const RowLayout& layout, ShortLoops& loops) {
    layout_ = &layout;
    if (numbers_.size() < layout.size * kNumbers) {
      numbers_.resize(layout.size * kNumbers);
      weights_.resize(layout.size * RowLane<Real>::kWeights);
    }
    const auto never = -static_cast<Real>((program.upper - program.lower).maxCoeff());
    loops.ForEach(layout.parts.size(), [&](std::size_t p) {
      for (const RowGroup& group : GroupsOf(p)) Fill(program, group, never);
    });
  }

  [[nodiscard]] const RowLayout& layout() const { return *layout_; }
  [[nodiscard]] std::span<const RowGroup> GroupsOf(std::size_t part) const {
    const RowPart& groups = layout_->parts[part];
    return std::span(layout_->groups).subspan(groups.begin, groups.end - groups.begin);
  }

  // The lane from row k on.
  [[nodiscard]] RowLane<Real> LaneAt(Eigen::Index k) {
    return {weights_.data() + k * RowLane<Real>::kWeights, numbers_.data() + k * kNumbers};
  }

  // Of the variables that a group's rows touch.
  static std::array<Real, 8> OwnPart(const RowGroup& group, const Eigen::VectorXd& of) {
    std::array<Real, 8> own{};
    for (int c = 0; c < 4; ++c) {
      own[c] = static_cast<Real>(of[group.first_a + c]);
      if (group.first_b >= 0) own[c + 4] = static_cast<Real>(of[group.first_b + c]);
    }
    return own;
  }

 private:
  static constexpr auto kNumbers = static_cast<Eigen::Index>(RowNumber::kCount);

  void Fill(const PenaltyProgram& program, const RowGroup& group, Real never) {
    Eigen::Index k = group.begin;
    for (std::size_t i = 0; i < group.count; ++i, ++k) {
      const RowPlace& place = layout_->order[group.first_in_order + i];
      const RowBatch& batch = program.batches[place.batch];
      const PenaltyRow& row = batch.rows[place.row];
      const RowLane<Real> lane = LaneAt(k - k % kLane);
      for (Eigen::Index c = 0; c < 8; ++c) {
        lane.coefficient(c)[k % kLane] = static_cast<Real>(row.coefficients[c]);
      }
      lane.value()[k % kLane] = static_cast<Real>(row.value);
      lane.penalty()[k % kLane] = static_cast<Real>(row.penalty * batch.penalty_factor);
    }
    for (; k < group.end; ++k) {
      const RowLane<Real> lane = LaneAt(k - k % kLane);
      for (Eigen::Index c = 0; c < 8; ++c) lane.coefficient(c)[k % kLane] = 0;
      lane.value()[k % kLane] = never;
      // As its neighbour, so that they converge like it.
      lane.penalty()[k % kLane] = LaneAt((k - 1) - (k - 1) % kLane).penalty()[(k - 1) % kLane];
    }
  }

  Eigen::Array<Real, Eigen::Dynamic, 1> weights_;
  Eigen::Array<Real, Eigen::Dynamic, 1> numbers_;
  const RowLayout* layout_ = nullptr;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_ROW_TABLE_H_
