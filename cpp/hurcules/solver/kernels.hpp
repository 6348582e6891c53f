// The two inner loops of the solver, on contiguous memory.
#pragma once

#include "hurcules/base/types.hpp"

namespace hurcules::kernels {

using Map = Eigen::Map<Vector>;
using ConstMap = Eigen::Map<const Vector>;

// a . b over n entries
inline double dot(Index n, const double* a, const double* b) {
  return ConstMap(a, n).dot(ConstMap(b, n));
}

// y += s x over n entries
inline void axpy(Index n, double s, const double* x, double* y) {
  Map(y, n) += s * ConstMap(x, n);
}

}  // namespace hurcules::kernels
