// The answer after each level of a hierarchy, from the solver's public face.
//
// x_k is the answer of the levels 0 .. k alone. The equality rows of the levels below stay, with a
// regularisation that pins them: they move nothing, and the solve takes the same path to level k as
// the whole one, so that x_k is that of the whole solve to the last digits even where it is
// sensitive to rounding.
#pragma once

#include <vector>

#include "hurcules/solver/solver.hpp"

namespace hurcules_test {

// the equality rows of a level, unable to move x
inline hurcules::Level pinned(const hurcules::Level& level, hurcules::Index unknowns) {
  constexpr double kPin = 1e100;
  hurcules::Level rows;
  rows.A.resize(level.rows(), unknowns);
  rows.lower.resize(level.rows());
  rows.rho = kPin;
  hurcules::Index count = 0;
  for (hurcules::Index i = 0; i < level.rows(); ++i) {
    if (level.lower[i] != level.upper[i]) continue;
    rows.lower[count] = level.lower[i];
    if (level.bounds) {
      rows.A.row(count++) = hurcules::Vector::Unit(unknowns, i).transpose();
    } else {
      rows.A.row(count++) = level.A.row(i);
    }
  }
  rows.A.conservativeResize(count, unknowns);
  rows.lower.conservativeResize(count);
  rows.upper = rows.lower;
  return rows;
}

// x[k] (n) after level k
inline std::vector<hurcules::Vector> answers_by_level(const hurcules::Hierarchy& levels,
                                                      hurcules::Index unknowns) {
  std::vector<hurcules::Vector> x;
  for (std::size_t whole = 1; whole <= levels.size(); ++whole) {
    hurcules::Hierarchy some(levels.begin(), levels.begin() + whole);
    for (std::size_t k = whole; k < levels.size(); ++k) some.push_back(pinned(levels[k], unknowns));
    x.push_back(hurcules::Solver(unknowns).solve(some).x);
  }
  return x;
}

}  // namespace hurcules_test
