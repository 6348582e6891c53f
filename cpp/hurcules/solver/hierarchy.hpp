// The problem as data: levels of bounded rows in decreasing priority.
//
// Level k asks  lower <= A x <= upper  (m rows, n unknowns) and is regularised by rho (solver.md
// §1, [T 3.3.35]):
//     min 1/2 |violation|^2 + 1/2 rho^2 |t|^2   over the step t from the solution of the levels
//     above.
// lower == upper makes a row an equality; a side of magnitude >= kInfinity is absent.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

// sides at or beyond this magnitude are absent
inline constexpr double kInfinity = 1e20;

struct Level {
  Matrix A;          // (m, n); empty for simple bounds
  Vector lower;      // (m)
  Vector upper;      // (m)
  double rho = 0.0;  // regularisation coefficient, >= 0; a level of limits wants 0
  bool bounds =
      false;  // simple bounds on x: A is the identity and is not stored; never regularised

  [[nodiscard]] Index rows() const { return lower.size(); }
};

// lower <= x <= upper as a level of its own, (n)
[[nodiscard]] Level make_bounds(const ConstVectorRef& lower, const ConstVectorRef& upper);

using Hierarchy = std::vector<Level>;

// Throws Error naming level and row on: wrong shapes, NaN, infinite A, lower > upper, rho < 0 or
// not finite.
void check(const Hierarchy& hierarchy, Index unknowns);
// the same for one level, called `name` in the text
void check(const Level& level, Index unknowns, const std::string& name);

}  // namespace hurcules
