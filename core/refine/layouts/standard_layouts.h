// Layouts that ship with capfit, by name.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_STANDARD_LAYOUTS_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_STANDARD_LAYOUTS_H_

#include <span>
#include <string>
#include <string_view>

#include "core/refine/layouts/kept_layout.h"

namespace capfit::refine {

// "standard-32": 32 spheres and 32 capsules for the whole body with head, hands and feet, the
// limits of NvCloth and Unity's Cloth. Symmetric. Numbers, names and capsules of a standard layout
// never change; a better one would get another name.
[[nodiscard]] std::span<const KeptLayout> StandardLayouts();

// Nothing for an unknown name.
[[nodiscard]] const KeptLayout* FindStandardLayout(std::string_view name);
// "standard-32": for messages.
[[nodiscard]] std::string StandardLayoutNames();

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_STANDARD_LAYOUTS_H_
