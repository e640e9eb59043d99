#pragma once
// Whether the tests are built with a sanitizer that takes several times as much memory and time as the
// program.

namespace kaustik::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace kaustik::test
