// What a set may cost: the one budget of all rooms.
#ifndef CAPFIT_CORE_CAPSULE_BUDGET_H_
#define CAPFIT_CORE_CAPSULE_BUDGET_H_

#include <algorithm>

namespace capfit::capsule {

// Where there is no limit. Far beyond any set, and small enough to be added up.
inline constexpr int kNoLimit = 1'000'000;

// A primitive is a sphere or a cone, shared spheres counted once (paper, IV-B: n_p).
struct PrimitiveCount {
  int spheres = 0;
  int capsules = 0;
  [[nodiscard]] int total() const { return spheres + capsules; }
};

struct Budget {
  int max_primitives = kNoLimit;
  int max_spheres = kNoLimit;
  int max_capsules = kNoLimit;

  [[nodiscard]] bool Allows(const PrimitiveCount& count) const { return Excess(count) <= 0; }

  // Whether only all primitives together are limited.
  [[nodiscard]] bool IsOfAnyKind() const {
    return max_spheres >= kNoLimit && max_capsules >= kNoLimit;
  }

  // By how many primitives the count is beyond the limit that it breaks most; 0 where it fits.
  [[nodiscard]] int Excess(const PrimitiveCount& count) const {
    return std::max({0, count.total() - max_primitives, count.spheres - max_spheres,
                     count.capsules - max_capsules});
  }

  // What is left beside `spent`; a limit of none stays none.
  [[nodiscard]] Budget Without(const PrimitiveCount& spent) const {
    const auto reduced = [](int limit, int by) {
      return limit >= kNoLimit ? kNoLimit : std::max(0, limit - by);
    };
    return {reduced(max_primitives, spent.total()), reduced(max_spheres, spent.spheres),
            reduced(max_capsules, spent.capsules)};
  }

  // The most primitives that fit.
  [[nodiscard]] int MostPrimitives() const {
    return std::min(max_primitives, max_spheres + max_capsules);
  }
  // About as many as a good set comes to, where a capsule goes with each sphere.
  [[nodiscard]] int UsualPrimitives() const {
    return std::min({MostPrimitives(), 2 * max_spheres, 2 * max_capsules + 1});
  }
  // As many primitives of whatever kind. Where spheres and capsules are limited apart and one limit
  // is much lower than the other, this budget itself: then that one is what a set has to be made
  // for.
  [[nodiscard]] Budget OfAnyKind() const {
    const int usual = UsualPrimitives();
    return MostPrimitives() <= usual + 1 ? Budget{usual, kNoLimit, kNoLimit} : *this;
  }
  // How many times a capsule may be cut in two: each is a sphere and a capsule more.
  [[nodiscard]] int Cuts() const {
    return std::min({max_spheres, max_capsules, max_primitives / 2});
  }
  // How many primitives a set of `count` leaves unused.
  [[nodiscard]] int Unused(const PrimitiveCount& count) const {
    return Without(count).MostPrimitives();
  }
};

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_BUDGET_H_
