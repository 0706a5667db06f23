// The component that brings unity_colliders.json onto a character.
#ifndef CAPFIT_CORE_EXPORT_UNITY_SCRIPT_H_
#define CAPFIT_CORE_EXPORT_UNITY_SCRIPT_H_

#include <string_view>

namespace capfit::exports {

// C#, for Unity 2019.4 and later; the part for Magica Cloth 2 compiles where the symbol
// MAGICACLOTH2 is defined, as its package does, the menu where UNITY_EDITOR is. The same for every
// set.
[[nodiscard]] std::string_view UnityScript();

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_UNITY_SCRIPT_H_
