// The unit of a body that nobody named.
#ifndef CAPFIT_CORE_BODY_BODY_UNIT_H_
#define CAPFIT_CORE_BODY_BODY_UNIT_H_

#include <optional>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/base/warning.h"
#include "core/body/find_body.h"

namespace capfit::body {

struct LengthUnit {
  Unit unit = Unit::kMetre;
  double metres = 1.0;
  std::string_view name;  // "metres"
};

// kAuto: the unit in which a body of this height is nearest to 1.6 m by ratio, so that 63 is inches
// and 158 centimetres. FAILED_PRECONDITION with reason UNIT_UNKNOWN when that still leaves it
// shorter than 0.4 m or taller than 2.8 m. A unit that is named is taken, but where it makes the
// body shorter than 0.25 m or taller than 3 m: INVALID_ARGUMENT with reason CONTRADICTS_BODY.
[[nodiscard]] absl::StatusOr<LengthUnit> ChooseUnit(Unit wanted, double height);

// What speaks against a unit that was named, all in that unit; nothing where it is credible.
// Another unit makes the height usual, or the volume is none for that height: people have 8 to 60
// litres for each cubic metre of height, and only infants, who are short, more than 17.
[[nodiscard]] std::optional<Warning> JudgeToldUnit(const LengthUnit& told, double height,
                                                   double volume);

// The unit of this many metres; kAuto where there is none.
[[nodiscard]] Unit UnitOf(double metres);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_BODY_UNIT_H_
