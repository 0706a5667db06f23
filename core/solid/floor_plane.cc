#include "core/solid/floor_plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/mesh/surface_sums.h"

namespace capfit::solid {
namespace {

// How far up from the end a stand's top may be, as a share of the whole extent.
constexpr double kHighestTop = 0.3;
// Heights are counted in this many bins over the extent.
constexpr int kBins = 120;
constexpr std::size_t kMostPeaks = 6;
// Distances from the plane, as shares of the extent, that count in one round of fitting after the
// other: noise and unevenness of a scanner's floor are below the last.
constexpr std::array<double, 6> kFitBands = {0.08, 0.05, 0.03, 0.02, 0.01, 0.006};
// A floor leans at most this much (cosine of 15 degrees).
constexpr double kLevel = 0.966;
// The rest is at least this much of its own width high: a wall behind somebody is no floor.
constexpr double kLeastHeight = 0.55;
// Bare floor there must be, as a share of the height's square: 0.07 m^2 under an adult. The brim of
// a hat has less, a turntable of half a metre more.
constexpr double kLeastBare = 0.025;
// The cells of the map of the floor, as a share of the height; what is above them between these
// heights stands there; and how many cells around it are not bare either.
constexpr double kCell = 0.01;
constexpr double kLowest = 0.015;
constexpr double kHighest = 0.09;
constexpr int kAround = 2;
// Cells a side of the map at most: floors wider than four heights are looked at near their middle.
constexpr int kMostCells = 400;
// Triangles are cut off that lie lower than this share of the height above the floor, or three
// times its roughness.
constexpr double kFloorMargin = 0.004;
constexpr double kRoughness = 3.0;

// Samples lie this far apart, as a share of the longest side of the box: there is at least one in
// each cell of the map. There are at most so many beside one in each triangle.
constexpr double kSpacing = 0.005;
constexpr double kMostSamples = 400'000.0;
// Planes are fitted to this many of them.
constexpr std::size_t kFewSamples = 8'000;
// A fit whose samples do not lie flatter than this share of the last band is not a plane.
constexpr double kFlatFloor = 0.5;

// A point of the surface with the area it stands for.
struct Sample {
  Eigen::Vector3d at;
  double area = 0.0;
};

// Points evenly over all triangles, a large one's by its size: a floor may be two triangles.
std::vector<Sample> SamplesOf(std::span<const Eigen::Vector3d> positions,
                              std::span<const mesh::Triangle> triangles) {
  Eigen::Vector3d low = positions[triangles[0][0]];
  Eigen::Vector3d high = low;
  double all = 0.0;
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t v : t) {
      low = low.cwiseMin(positions[v]);
      high = high.cwiseMax(positions[v]);
    }
    all += mesh::AreaVector(positions, t).norm();
  }
  const double spacing =
      std::max(kSpacing * (high - low).maxCoeff(), std::sqrt(all / kMostSamples));
  std::vector<Sample> samples;
  samples.reserve(2 * triangles.size());
  for (const mesh::Triangle& t : triangles) {
    const Eigen::Vector3d& a = positions[t[0]];
    const Eigen::Vector3d ab = positions[t[1]] - a;
    const Eigen::Vector3d ac = positions[t[2]] - a;
    const double area = 0.5 * ab.cross(ac).norm();
    // Triangles between n parallel lines each way, their middles; as many as the area asks for.
    const auto n = std::max(1, static_cast<int>(std::sqrt(2.0 * area) / spacing));
    for (int i = 0; i < n; ++i) {
      for (int k = 0; i + k < n; ++k) {
        samples.push_back({a + ((i + 1.0 / 3.0) * ab + (k + 1.0 / 3.0) * ac) / n, area / n / n});
        if (i + k + 1 < n) {
          samples.push_back({a + ((i + 2.0 / 3.0) * ab + (k + 2.0 / 3.0) * ac) / n, area / n / n});
        }
      }
    }
  }
  return samples;
}

// About kFewSamples of them, evenly; their areas stand for all.
std::vector<Sample> SomeOf(const std::vector<Sample>& samples) {
  const std::size_t every = samples.size() / kFewSamples + 1;
  std::vector<Sample> some;
  for (std::size_t i = 0; i < samples.size(); i += every) {
    some.push_back({samples[i].at, samples[i].area * static_cast<double>(every)});
  }
  return some;
}

struct Plane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  double roughness = 0.0;  // root of the mean square of the distances
  double area = 0.0;

  [[nodiscard]] double HeightOf(const Eigen::Vector3d& p) const { return up.dot(p - point); }
};

// The best plane of the samples within `band` of `start`; nothing where there are too few.
std::optional<Plane> Refit(std::span<const Sample> samples, const Plane& start, double band) {
  double area = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Sample& s : samples) {
    if (std::abs(start.HeightOf(s.at)) > band) continue;
    const Eigen::Vector3d d = s.at - start.point;
    area += s.area;
    sum += s.area * d;
    products += s.area * d * d.transpose();
  }
  if (!(area > 0.0)) return std::nullopt;
  const Eigen::Vector3d mean = sum / area;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(products / area -
                                                            mean * mean.transpose());
  Plane plane = {start.point + mean, axes.eigenvectors().col(0),
                 std::sqrt(std::max(0.0, axes.eigenvalues()[0])), area};
  if (plane.up.dot(start.up) < 0.0) plane.up = -plane.up;
  return plane;
}

// Judges one plane.
class FloorChecker {
 public:
  FloorChecker(std::span<const Sample> samples, const Plane& plane)
      : samples_(samples), plane_(plane) {}

  // The floor with its map, where it is one.
  std::optional<FloorPlane> Run() {
    result_.floor.point = plane_.point;
    result_.floor.up = plane_.up;
    if (!MeasureRest() || !MapFloor()) return std::nullopt;
    result_.floor.margin = Margin();
    return std::move(result_);
  }

  // Of what stands on it.
  [[nodiscard]] double height() const { return height_; }

 private:
  [[nodiscard]] double Margin() const {
    return std::max(kFloorMargin * height_, kRoughness * plane_.roughness);
  }

  // What stands on it is higher than wide, and little is below.
  bool MeasureRest() {
    double low = 0.0;
    for (const Sample& s : samples_) {
      const double height = plane_.HeightOf(s.at);
      height_ = std::max(height_, height);
      low = std::min(low, height);
    }
    if (-low > kHighestTop / (1.0 - kHighestTop) * height_) return false;
    result_.across = plane_.up.unitOrthogonal();
    result_.along = plane_.up.cross(result_.across);
    Eigen::Vector2d min = Eigen::Vector2d::Constant(1e300);
    Eigen::Vector2d max = -min;
    for (const Sample& s : samples_) {
      if (plane_.HeightOf(s.at) < kHighest * height_) continue;
      const Eigen::Vector3d d = s.at - plane_.point;
      const Eigen::Vector2d p(result_.across.dot(d), result_.along.dot(d));
      min = min.cwiseMin(p);
      max = max.cwiseMax(p);
    }
    return height_ > kLeastHeight * (max - min).maxCoeff();
  }

  bool MapFloor() {
    result_.cell = kCell * height_;
    result_.size = kMostCells;
    std::vector<char> flat(std::size_t{kMostCells} * kMostCells, 0);
    std::vector<char> taken = flat;
    for (const Sample& s : samples_) {
      const double height = plane_.HeightOf(s.at);
      const int cell = result_.CellOf(s.at);
      if (cell < 0) continue;
      if (std::abs(height) < Margin()) flat[cell] = 1;
      if (height > kLowest * height_ && height < kHighest * height_) taken[cell] = 1;
    }
    taken = WithSurroundings(taken);
    FillHoles(taken);
    result_.bare.assign(flat.size(), 0);
    int count = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      result_.bare[i] = flat[i] != 0 && taken[i] == 0 ? 1 : 0;
      count += result_.bare[i];
    }
    return count * kCell * kCell > kLeastBare;
  }

  static std::vector<char> WithSurroundings(const std::vector<char>& cells) {
    std::vector<char> wide = cells;
    for (int y = kAround; y + kAround < kMostCells; ++y) {
      for (int x = kAround; x + kAround < kMostCells; ++x) {
        if (cells[y * kMostCells + x] == 0) continue;
        for (int dy = -kAround; dy <= kAround; ++dy) {
          for (int dx = -kAround; dx <= kAround; ++dx) wide[(y + dy) * kMostCells + x + dx] = 1;
        }
      }
    }
    return wide;
  }

  // Cells that `taken` ones enclose become taken: the sole below a hollow leg.
  static void FillHoles(std::vector<char>& taken) {
    std::vector<char> reached(taken.size(), 0);
    std::vector<int> open = {0};
    reached[0] = 1;
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      const int x = cell % kMostCells;
      for (const int next : {x > 0 ? cell - 1 : -1, x + 1 < kMostCells ? cell + 1 : -1,
                             cell - kMostCells, cell + kMostCells}) {
        if (next < 0 || next >= static_cast<int>(taken.size())) continue;
        if (reached[next] != 0 || taken[next] != 0) continue;
        reached[next] = 1;
        open.push_back(next);
      }
    }
    for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = reached[i] == 0 ? 1 : 0;
  }

  std::span<const Sample> samples_;
  Plane plane_;
  double height_ = 0.0;
  FloorPlane result_;
};

// Looks for floors at one end of one of the caller's axes.
class EndSearch {
 public:
  EndSearch(std::span<const Sample> samples, const Eigen::Vector3d& up)
      : samples_(samples), up_(up) {
    for (const Sample& s : samples) {
      low_ = std::min(low_, up.dot(s.at));
      high_ = std::max(high_, up.dot(s.at));
    }
  }

  // Planes that may be floors, of different heights; the highest first.
  [[nodiscard]] std::vector<Plane> Run() const {
    std::vector<Plane> planes;
    for (const double start : Peaks()) {
      const std::optional<Plane> plane = FitFrom(start);
      if (!plane.has_value() || !IsLikely(*plane)) continue;
      const bool is_known = std::any_of(planes.begin(), planes.end(), [&](const Plane& other) {
        return std::abs(other.HeightOf(plane->point)) < kFitBands.back() * extent();
      });
      if (!is_known) planes.push_back(*plane);
    }
    std::sort(planes.begin(), planes.end(),
              [&](const Plane& a, const Plane& b) { return up_.dot(a.point) > up_.dot(b.point); });
    return planes;
  }

 private:
  [[nodiscard]] double extent() const { return high_ - low_; }

  [[nodiscard]] bool IsLikely(const Plane& plane) const {
    const double height = high_ - up_.dot(plane.point);
    return plane.up.dot(up_) > kLevel && plane.area > kLeastBare * height * height &&
           plane.roughness < kFlatFloor * kFitBands.back() * extent();
  }

  // Heights above the low end where most area is.
  [[nodiscard]] std::vector<double> Peaks() const {
    std::array<double, kBins> area{};
    for (const Sample& s : samples_) {
      const double share = (up_.dot(s.at) - low_) / extent();
      area[std::clamp(static_cast<int>(share * kBins), 0, kBins - 1)] += s.area;
    }
    std::vector<std::pair<double, int>> bins;
    for (int i = 0; i < static_cast<int>(kHighestTop * kBins); ++i) bins.emplace_back(-area[i], i);
    std::sort(bins.begin(), bins.end());
    std::vector<double> peaks;
    for (std::size_t i = 0; i < std::min(kMostPeaks, bins.size()); ++i) {
      peaks.push_back((bins[i].second + 0.5) / kBins * extent());
    }
    return peaks;
  }

  [[nodiscard]] std::optional<Plane> FitFrom(double height) const {
    Plane plane;
    plane.up = up_;
    plane.point = (low_ + height) * up_;
    for (const double band : kFitBands) {
      const std::optional<Plane> next = Refit(samples_, plane, band * extent());
      if (!next.has_value()) return std::nullopt;
      plane = *next;
    }
    return plane;
  }

  std::span<const Sample> samples_;
  Eigen::Vector3d up_;
  double low_ = 1e300;
  double high_ = -1e300;
};

}  // namespace

int FloorPlane::CellOf(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d d = p - floor.point;
  const double x = std::floor(across.dot(d) / cell) + size / 2;
  const double y = std::floor(along.dot(d) / cell) + size / 2;
  if (!(x >= 0.0 && y >= 0.0 && x < size && y < size)) return -1;
  return static_cast<int>(y) * size + static_cast<int>(x);
}

std::optional<FloorPlane> FindFloorPlane(std::span<const Eigen::Vector3d> positions,
                                         std::span<const mesh::Triangle> triangles) {
  const std::vector<Sample> samples = SamplesOf(positions, triangles);
  const std::vector<Sample> some = SomeOf(samples);
  std::optional<FloorPlane> best;
  double most = 0.0;  // height above the best
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      for (const Plane& plane : EndSearch(some, sign * Eigen::Vector3d::Unit(axis)).Run()) {
        FloorChecker checker(samples, plane);
        std::optional<FloorPlane> floor = checker.Run();
        if (!floor.has_value()) continue;
        if (checker.height() > most) best = std::move(floor);
        most = std::max(most, checker.height());
        break;  // what lies lower at this end lies under the floor
      }
    }
  }
  return best;
}

}  // namespace capfit::solid
