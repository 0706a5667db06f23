#include "core/section/part_section.h"

#include "core/section/outline.h"
#include "core/section/plane_section.h"

namespace capfit::section {

bool TakesIn(body::Part chain, body::Segment segment) {
  using body::Part;
  using body::Segment;
  switch (segment) {
    case Segment::kTorso:
    case Segment::kNeck:
      return chain == Part::kTorso;
    case Segment::kHead:
      return false;
    case Segment::kLeftUpperArm:
    case Segment::kLeftForearm:
    case Segment::kLeftHand:
      return chain == Part::kLeftArm;
    case Segment::kRightUpperArm:
    case Segment::kRightForearm:
    case Segment::kRightHand:
      return chain == Part::kRightArm;
    case Segment::kLeftThigh:
      return chain == Part::kLeftLeg || chain == Part::kTorso;
    case Segment::kRightThigh:
      return chain == Part::kRightLeg || chain == Part::kTorso;
    case Segment::kLeftCalf:
    case Segment::kLeftFoot:
      return chain == Part::kLeftLeg;
    case Segment::kRightCalf:
    case Segment::kRightFoot:
      return chain == Part::kRightLeg;
  }
  return false;
}

std::optional<std::vector<Eigen::Vector2d>> PartCutter::Cut(
    body::Part chain, const geometry::PlaneFrame& plane) const {
  return PartOutline(CutMesh(*mesh_, plane), [&](std::uint32_t vertex) {
    return TakesIn(chain, body_.vertex_segments[vertex]);
  });
}

}  // namespace capfit::section
