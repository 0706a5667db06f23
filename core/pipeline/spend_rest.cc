#include "core/pipeline/spend_rest.h"

#include <utility>

#include "core/capsule/cut_capsules.h"

namespace capfit::pipeline {

void SpendRest(const capsule::Budget& budget, capsule::PrimitiveSet& set) {
  capsule::MirroredSet mirrored(std::move(set), /*is_mirrored=*/true);
  capsule::CutWorthiest(budget, capsule::OutlineAreas(mirrored), capsule::QuarterOfWhole, mirrored);
  set = mirrored.set();
}

}  // namespace capfit::pipeline
