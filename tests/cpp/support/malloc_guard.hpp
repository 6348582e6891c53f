// Arms Eigen's allocation guard where its other assertions are compiled out (HurculesSettings.cmake
// includes this first).
//
// EIGEN_RUNTIME_NO_MALLOC checks through eigen_assert, which NDEBUG removes. Here the one assertion
// about allocation is kept and all others still cost nothing, so that one optimised build serves
// the module, the tests and the benchmarks.
#pragma once

#ifdef NDEBUG

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace hurcules_test {

constexpr bool is_malloc_guard(std::string_view condition) {
  return condition.starts_with("is_malloc_allowed()");
}

[[noreturn]] inline void allocation_forbidden() {
  std::fputs("Eigen allocated where it is forbidden\n", stderr);
  std::abort();
}

}  // namespace hurcules_test

#define eigen_assert(condition)                                   \
  do {                                                            \
    if constexpr (::hurcules_test::is_malloc_guard(#condition)) { \
      if (!(condition)) ::hurcules_test::allocation_forbidden();  \
    }                                                             \
  } while (false)

#endif
