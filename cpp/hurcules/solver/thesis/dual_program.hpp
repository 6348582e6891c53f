// A strictly convex quadratic program by the dual active set method [G].
//
//     min 1/2 y'H y - g'y   s.t.  C y >= d
// Dense, and every factor is made anew at each change: plain and slow. It shares nothing with the
// default method, so that the two can judge each other.
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

struct QuadraticProgram {
  Matrix H;          // (size, size), positive definite
  Vector g;          // (size)
  Matrix C;          // (rows, size)
  Vector d;          // (rows)
  Vector tolerance;  // (rows): a row is broken when C y < d - tolerance
};

struct QuadraticAnswer {
  Vector y;              // (size)
  Vector multipliers;    // (rows), >= 0
  int changes = 0;       // rows added and dropped
  bool optimal = false;  // false: ended at max_changes, or H is not positive definite
};

[[nodiscard]] QuadraticAnswer minimize(const QuadraticProgram& program, int max_changes);

}  // namespace hurcules
