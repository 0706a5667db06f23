// One section of one chain: cut, told apart from the other parts, and closed.
#ifndef CAPFIT_CORE_SECTION_PART_SECTION_H_
#define CAPFIT_CORE_SECTION_PART_SECTION_H_

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/geometry/plane_frame.h"
#include "core/mesh/plane_cutter.h"

namespace capfit::section {

// Whether flesh labelled `segment` belongs to sections of `chain`. Sections of the torso take in
// the thighs, because the lowest ones lie at the height where the thighs begin, and those of limbs
// the hand or foot, because the last ones lie at its border.
[[nodiscard]] bool TakesIn(body::Part chain, body::Segment segment);

// Cuts the parts of one body, which must outlive it.
class PartCutter {
 public:
  // O(triangles) where the body has no cutter.
  PartCutter(const body::Body& body, const ThreadPool& pool)
      : body_(body),
        mesh_(body.cutter ? body.cutter
                          : std::make_shared<const mesh::PlaneCutter>(
                                body.mesh.vertices(), body.mesh.triangles(), pool)) {}

  // The chain's own outline in the plane, in `plane`'s coordinates, counter-clockwise, as cut (not
  // resampled). Nothing where the plane misses the chain.
  [[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> Cut(
      body::Part chain, const geometry::PlaneFrame& plane) const;

  [[nodiscard]] const body::Body& body() const { return body_; }

 private:
  const body::Body& body_;
  std::shared_ptr<const mesh::PlaneCutter> mesh_;
};

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_PART_SECTION_H_
