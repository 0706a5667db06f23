// Vectors for large arrays that are written by several threads at once.
#ifndef CAPFIT_CORE_BASE_RAW_VECTOR_H_
#define CAPFIT_CORE_BASE_RAW_VECTOR_H_

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace capfit {

// Leaves items without a value that are made without one.
template <typename T>
struct RawAllocator : std::allocator<T> {
  template <typename U>
  void construct(U* place) noexcept(std::is_nothrow_default_constructible_v<U>) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
};

// A vector whose size can be set without one thread filling it with zeros first: what resize adds
// has no value until it is written.
template <typename T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_RAW_VECTOR_H_
