// The multipliers of the smallest step of a level whose regularisation is nothing, where its working
// set came with others.
//
// At a vertex with more limits than directions they are not unique, and those that a warm start
// comes with may have the wrong sign although its x is right. They are sought anew,
//     t + sum nu_w side_w a_w = 0,   nu >= 0, of all rows at their limits,
// in the coordinates of the basis, which is complete: no more exact than double, so that they are
// still to be proven, but at next to no cost.
#pragma once

#include <vector>

#include "hurcules/solver/kernels/padded.hpp"
#include "hurcules/solver/optimality/nonnegative_least_squares.hpp"
#include "hurcules/solver/optimality/optimality.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

class StepMultipliers {
 public:
  // A level between x_above and record.x, of size x_scale, with the values of its candidates there.
  struct Step {
    const RowTable& rows;
    const NullspaceBasis& nullspace;
    const Candidates& candidates;
    int level;
    const double* x_above;
    double x_scale;
    const LevelRecord& record;
  };

  void reserve(Index unknowns, Index rows);
  // Puts them behind `held`, the rows that push against the violations; false where own inequality
  // rows are violated, or the level is regularised.
  bool find(const Step& step, std::vector<HeldRow>& held);

 private:
  using Long = long double;
  struct Push {
    int row;
    Side side;
    double left;  // part of the row in the free directions
  };

  // a row that may stand at its limit
  void push(const Step& step, int row);

  NonnegativeLeastSquares balance_;
  std::vector<Push> pushes_;
  std::vector<char> pushing_;  // (rows) against the violations
  std::vector<Long> free_;     // the step in the free directions
  PaddedVector moved_, coordinates_;
};

}  // namespace hurcules
