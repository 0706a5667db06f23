// Tables with an entry for each enumerator.
#ifndef CAPFIT_CORE_BASE_ENUM_INDEX_H_
#define CAPFIT_CORE_BASE_ENUM_INDEX_H_

#include <cstddef>
#include <type_traits>

namespace capfit {

// Where an enumerator's entry is, in tables in the order in which the enumerators are declared.
template <typename Enum>
requires std::is_enum_v<Enum>
[[nodiscard]] constexpr std::size_t Index(Enum enumerator) {
  return static_cast<std::size_t>(enumerator);
}

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_ENUM_INDEX_H_
