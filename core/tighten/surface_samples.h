// Samples of a solid's surface, some of them hidden by others, in vector registers.
#ifndef CAPFIT_CORE_TIGHTEN_SURFACE_SAMPLES_H_
#define CAPFIT_CORE_TIGHTEN_SURFACE_SAMPLES_H_

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace capfit::tighten {

// Cosine and sine of angles in equal steps.
struct Turner {
  Turner(double first, double step)
      : cosine(std::cos(first)), sine(std::sin(first)), c(std::cos(step)), s(std::sin(step)) {}
  void Next() {
    const double old = cosine;
    cosine = old * c - sine * s;
    sine = old * s + sine * c;
  }
  double cosine, sine, c, s;
};

// Samples of the surface as seen from a place of their own, their coordinates apart.
struct Samples {
  static constexpr int kLane = 8;
  static constexpr int kMost = 8 * kLane;
  int count = 0;
  std::array<float, kMost> x, y, z, nx, ny, nz;
  std::array<float, kMost> seen;  // share that nothing hides

  [[nodiscard]] bool IsFull() const { return count == kMost; }
  void Add(const Eigen::Vector3f& normal, const Eigen::Vector3f& center, float radius) {
    const int i = count++;
    nx[i] = normal.x(), ny[i] = normal.y(), nz[i] = normal.z();
    x[i] = center.x() + radius * normal.x();
    y[i] = center.y() + radius * normal.y();
    z[i] = center.z() + radius * normal.z();
    seen[i] = 1.0f;
  }

  // Up to whole lanes with samples that count for nothing, so that all that follows is done in
  // vector registers.
  void FillUp() {
    while (count % kLane != 0) {
      const int last = count - 1;
      Add({nx[last], ny[last], nz[last]}, {x[last], y[last], z[last]}, 0.0f);
      seen[last + 1] = 0.0f;
    }
  }

  // Multiplies what is seen of each sample with what `share_of` gives for its index.
  template <typename ShareOf>
  void Hide(const ShareOf& share_of) {
    for (int first = 0; first < count; first += kLane) {
      if (!IsSeen(first)) continue;
      for (int i = first; i < first + kLane; ++i) seen[i] *= share_of(i);
    }
  }

  // Moves the samples that are seen to `to`, calls `when_full` each time that is full and should
  // empty it, and leaves none here.
  template <typename WhenFull>
  void MoveSeen(Samples& to, const WhenFull& when_full) {
    for (int i = 0; i < count; ++i) {
      if (seen[i] == 0.0f) continue;
      const int next = to.count++;
      to.x[next] = x[i], to.y[next] = y[i], to.z[next] = z[i];
      to.nx[next] = nx[i], to.ny[next] = ny[i], to.nz[next] = nz[i];
      to.seen[next] = seen[i];
      if (to.IsFull()) when_full();
    }
    count = 0;
  }

 private:
  // Whether any sample of a lane is: shares are never negative, so one with any bit set is seen.
  [[nodiscard]] bool IsSeen(int first) const {
    std::array<std::uint64_t, kLane * sizeof(float) / sizeof(std::uint64_t)> bits;
    std::memcpy(bits.data(), seen.data() + first, sizeof(bits));
    return (bits[0] | bits[1] | bits[2] | bits[3]) != 0;
  }
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_SURFACE_SAMPLES_H_
