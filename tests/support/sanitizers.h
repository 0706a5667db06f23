// Whether a sanitizer watches: it has a malloc of its own, and takes time and memory of its own.
#ifndef CAPFIT_TESTS_SUPPORT_SANITIZERS_H_
#define CAPFIT_TESTS_SUPPORT_SANITIZERS_H_

namespace capfit::test_support {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // GCC
inline constexpr bool kIsSanitized = true;
#elif defined(__has_feature)  // clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace capfit::test_support

#endif  // CAPFIT_TESTS_SUPPORT_SANITIZERS_H_
