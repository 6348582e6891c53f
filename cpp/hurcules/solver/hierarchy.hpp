// The problem as data: levels of bounded rows in decreasing priority.
//
// Level k asks  lower <= A x <= upper  (m rows, n unknowns) and is regularised by rho (solver.md
// §1, [T 3.3.35]):
//     min 1/2 |violation|^2 + 1/2 rho^2 |t|^2
// over the step t from the solution of the levels above.
// lower == upper makes a row an equality; a side of magnitude >= kInfinity is absent.
#pragma once

#include <span>
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

// the longest row that a solve takes: beyond, its square would be infinite
inline constexpr double kLongestRow = 1e100;

// A level whose numbers belong to somebody else: what a solve reads. They must stay where they are
// while it runs.
struct LevelView {
  Eigen::Map<const Matrix> A{nullptr, 0, 0};                      // (m, n); empty for simple bounds
  Eigen::Map<const Vector> lower{nullptr, 0}, upper{nullptr, 0};  // (m)
  double rho = 0.0;
  bool bounds = false;

  [[nodiscard]] Index rows() const { return lower.size(); }
};
using HierarchyView = std::span<const LevelView>;
[[nodiscard]] LevelView view(const Level& level);

// Throws Error naming level and row on: wrong shapes, NaN, infinite A, lower > upper, rho < 0 or
// not finite.
void check(HierarchyView hierarchy, Index unknowns);
void check(const Hierarchy& hierarchy, Index unknowns);
// the same for one level, called `name` in the text
void check(const LevelView& level, Index unknowns, const std::string& name);
void check(const Level& level, Index unknowns, const std::string& name);

}  // namespace hurcules
