// Vectors of kWidth doubles; part of impl.hpp.
#pragma once

#include <cstring>
#include <limits>

#include "hurcules/solver/kernels/kernels.hpp"

namespace hurcules::kernels {
namespace {

constexpr int kWidth = HURCULES_KERNEL_WIDTH;
constexpr const char* kName = kWidth == 4 ? "avx2" : "baseline";

using Pack = double __attribute__((vector_size(kWidth * sizeof(double))));
using Mask = long long __attribute__((vector_size(kWidth * sizeof(double))));

constexpr double kInfinite = std::numeric_limits<double>::infinity();

inline Pack load(const double* p) {
  Pack v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(double* p, Pack v) {
  std::memcpy(p, &v, sizeof v);
}
inline Pack spread(double s) {
  return Pack{} + s;
}
inline double sum(Pack v) {
  double total = v[0];
  for (int i = 1; i < kWidth; ++i) total += v[i];
  return total;
}

// four sums at once
inline void sums(Pack a, Pack b, Pack c, Pack d, double* out) {
#if HURCULES_KERNEL_WIDTH == 4
  const Pack ab =
      __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Pack cd =
      __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  store(out,
        __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
#else
  store(out, __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3));
  store(out + 2, __builtin_shufflevector(c, d, 0, 2) + __builtin_shufflevector(c, d, 1, 3));
#endif
}

}  // namespace
}  // namespace hurcules::kernels
