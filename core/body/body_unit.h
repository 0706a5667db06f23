// The unit of a body that nobody named.
#ifndef CAPFIT_CORE_BODY_BODY_UNIT_H_
#define CAPFIT_CORE_BODY_BODY_UNIT_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "core/body/find_body.h"

namespace capfit::body {

struct LengthUnit {
  Unit unit = Unit::kMetre;
  double metres = 1.0;
  std::string_view name;  // "metres"
};

// kAuto: the unit in which a body of this height is nearest to 1.6 m by ratio, so that 63 is inches
// and 158 centimetres. FAILED_PRECONDITION with reason UNIT_UNKNOWN when that still leaves it
// shorter than 0.4 m or taller than 2.8 m. A unit that is named is taken for any height.
[[nodiscard]] absl::StatusOr<LengthUnit> ChooseUnit(Unit wanted, double height);

// The unit of this many metres; kAuto where there is none.
[[nodiscard]] Unit UnitOf(double metres);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_BODY_UNIT_H_
