#include "core/formats/recover_decimals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/base/chunk_sums.h"

namespace capfit::formats {
namespace {

// Half the distance of two floats, at most, as a share of their size.
constexpr double kFloatRounding = 0x1p-24;
// Powers of ten that doubles hold exactly, so that one division gives the double nearest to the
// decimal.
constexpr int kMostDigits = 22;
constexpr double kLargestInteger = 0x1p53;
// Evidence that no chance agreement reaches: natural logarithm of one in 10^43.
constexpr double kEnoughEvidence = 100.0;
constexpr Eigen::Index kAtOnce = 1024;

// Multiples of one power of ten.
class DecimalGrid {
 public:
  // `digits` behind the point; negative: zeros before it.
  DecimalGrid(int digits, double tolerance)
      : power_(std::pow(10.0, std::abs(digits))), is_fine_(digits >= 0), tolerance_(tolerance) {}

  [[nodiscard]] double step() const { return is_fine_ ? 1.0 / power_ : power_; }
  [[nodiscard]] double Nearest(double x) const {
    return is_fine_ ? std::nearbyint(x * power_) / power_ : std::nearbyint(x / power_) * power_;
  }
  [[nodiscard]] double Reach(double decimal) const {
    return kFloatRounding * std::abs(decimal) + tolerance_;
  }
  // How unlikely it is that a random coordinate lies so near to the grid: minus the logarithm of
  // the chance; nothing where this one does not.
  [[nodiscard]] std::optional<double> EvidenceOf(double x) const {
    const double decimal = Nearest(x);
    const double reach = Reach(decimal);
    if (!(std::abs(x - decimal) <= reach)) return std::nullopt;  // NaN neither
    return reach > 0.0 ? std::max(0.0, -std::log(2.0 * reach / step())) : 0.0;
  }

 private:
  double power_;
  bool is_fine_;
  double tolerance_;
};

bool IsOnGrid(const Eigen::Vector3d& position, const DecimalGrid& grid, double& evidence) {
  for (const double x : position) {
    const std::optional<double> more = grid.EvidenceOf(x);
    if (!more.has_value()) return false;
    evidence += *more;
  }
  return true;
}

// `doubtful` is the position that lay on no grid last; it is asked first, so that one position that
// is no decimal costs one pass over the others and not one for each grid.
bool AllOnGrid(std::span<const Eigen::Vector3d> positions, const DecimalGrid& grid,
               std::size_t& doubtful) {
  double evidence = 0.0;
  if (!IsOnGrid(positions[doubtful], grid, evidence)) return false;
  evidence = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (IsOnGrid(positions[i], grid, evidence)) continue;
    doubtful = i;
    return false;
  }
  return evidence >= kEnoughEvidence;
}

using Coordinates = Eigen::Map<const Eigen::ArrayXd>;

Coordinates CoordinatesOf(std::span<const Eigen::Vector3d> positions) {
  return {positions.empty() ? nullptr : positions.front().data(),
          static_cast<Eigen::Index>(3 * positions.size())};
}

double LargestCoordinate(std::span<const Eigen::Vector3d> positions) {
  return positions.empty() ? 0.0 : CoordinatesOf(positions).abs().maxCoeff();
}

bool AllFloats(std::span<const Eigen::Vector3d> positions) {
  const Coordinates all = CoordinatesOf(positions);
  for (Eigen::Index begin = 0; begin < all.size(); begin += kAtOnce) {
    const auto some = all.segment(begin, std::min(kAtOnce, all.size() - begin));
    if (!(some.cast<float>().cast<double>() == some).all()) return false;
  }
  return true;
}

bool AllFloats(std::span<const Eigen::Vector3d> positions, const ThreadPool& pool) {
  const auto bad_chunk = [&](std::size_t begin, std::size_t end) {
    return std::size_t{AllFloats(positions.subspan(begin, end - begin)) ? 0u : 1u};
  };
  return SumOverChunks(pool, positions.size(), std::size_t{0}, bad_chunk) == 0;
}

}  // namespace

std::vector<Eigen::Vector3d> RecoverDecimals(std::span<const Eigen::Vector3d> positions,
                                             double tolerance) {
  const double largest = LargestCoordinate(positions);
  if (!(largest > 1e-12) || largest > 1e12) return {};
  std::size_t doubtful = 0;
  // From the coarsest step to the one that lies within the rounding of the largest coordinate.
  for (int digits = -static_cast<int>(std::floor(std::log10(largest))); digits <= kMostDigits;
       ++digits) {
    const DecimalGrid grid(digits, tolerance);
    if (largest / grid.step() > kLargestInteger || grid.step() < grid.Reach(largest)) break;
    if (!AllOnGrid(positions, grid, doubtful)) continue;
    std::vector<Eigen::Vector3d> decimals(positions.begin(), positions.end());
    for (Eigen::Vector3d& position : decimals) {
      for (double& x : position) x = grid.Nearest(x) + 0.0;  // no negative zero
    }
    return decimals;
  }
  return {};
}

std::vector<Eigen::Vector3d> RecoverDecimalsOfFloats(std::span<const Eigen::Vector3d> positions,
                                                     const ThreadPool& pool) {
  return AllFloats(positions, pool) ? RecoverDecimals(positions) : std::vector<Eigen::Vector3d>();
}

}  // namespace capfit::formats
