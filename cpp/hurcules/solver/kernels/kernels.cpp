#include "hurcules/solver/kernels/kernels.hpp"

#include <cstring>

namespace hurcules::kernels {

const Table* baseline();
const Table* avx2();

namespace {

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

const Table* widest() {
  return has_avx2() && avx2() ? avx2() : baseline();
}

}  // namespace

const Table* chosen = widest();

bool choose(const char* name) {
  if (std::strcmp(name, "baseline") == 0) {
    chosen = baseline();
    return true;
  }
  if (std::strcmp(name, "avx2") != 0 || !has_avx2() || !avx2()) return false;
  chosen = avx2();
  return true;
}

}  // namespace hurcules::kernels
