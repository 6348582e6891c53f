// How x after one level moves with the numbers of the hierarchy and with what the levels above
// left, and the same transposed: sensitivity.hpp has the equations and goes from level to level.
#pragma once

#include <vector>

#include "hurcules/solver/sensitivity/level_kkt_system.hpp"

namespace hurcules {

// A change of the numbers of one level, or the gradient of a function in them. An array of size
// zero is no change.
struct LevelChange {
  Matrix A;             // (m, n); empty for simple bounds
  Vector lower, upper;  // (m); an equality row moves with the mean of both
  double rho = 0.0;
};

// the changes of a list of rows, (rows, n)
[[nodiscard]] Matrix row_changes(const SolvedHierarchy& solved,
                                 const std::vector<DecidingRow>& rows,
                                 const std::vector<LevelChange>& changes);

// what moves x_k beside the rows of the hierarchy, or the gradient in it
struct Moved {
  Vector x_above;  // (n)
  Matrix B;        // (n, n); empty: it stands
  double rho = 0.0;
};

// dx after the level of a piece
[[nodiscard]] Vector advance(const SolvedHierarchy& solved, const LevelKktSystem& piece,
                             const std::vector<LevelChange>& changes, const Moved& moved);
// transposed: x_bar after the level -> the gradient in what moved it; that in rows is added
[[nodiscard]] Moved retreat(const SolvedHierarchy& solved, const LevelKktSystem& piece,
                            const Vector& x_bar, std::vector<LevelChange>& gradient);

}  // namespace hurcules
