// The second look at a level, where the multipliers that its way came with do not prove it.
//
// At a vertex with more limits than directions many sets of multipliers exist, and a working set
// may stand for the wrong one; and forces of 1e20 hide an imbalance of 1e10 when it is measured
// against them. So the multipliers are sought anew, from the rows and x alone, in long double: on
// what the equality rows above leave free,
//     rho^2 t + sum v_i a_i + sum mu_w side_w a_w = 0,   mu >= 0, of rows above at their limits,
// and where the step has to be the smallest, on what the violated rows leave, too,
//     t + sum nu_w side_w a_w = 0,   nu >= 0, of all rows at their limits.
// What is left is measured against the forces without the multipliers; those count with their
// rounding alone, and no more than the forces: multipliers that round by more prove nothing.
#pragma once

#include <vector>

#include "hurcules/solver/optimality/nonnegative_least_squares.hpp"
#include "hurcules/solver/optimality/optimality.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

class Certificate {
 public:
  void reserve(Index unknowns, Index rows);
  // The worst residual of level k between x_above and record.x, of size x_scale; a basis that is
  // whole. Then `keep` lists its rows.
  double find(const RowTable& rows, const NullspaceBasis& nullspace, int k, const double* x_above,
              double x_scale, const LevelRecord& record);
  // the rows with their multipliers, those of the smallest step from begin_norm on
  void keep(std::vector<HeldRow>& held, int& begin_norm);

 private:
  using Long = long double;
  struct Push {
    int row;
    Side side;
    Long left;    // part of the row outside the basis
    Long weight;  // of the row at length one
  };

  void use_equalities(Index first, Index end);
  // rho^2 t + sum v_i a_i of the own rows -> force_; the size of what is in it
  Long own_forces(double rho);
  void settle_violated();
  void push_limits(int first, int end, bool above, std::vector<Push>& pushes);
  void push(int row, Side side, std::vector<Push>& pushes);
  // what of v the pushes do not balance, relative to `scale`
  double balance(const Long* v, Long scale, std::vector<Push>& pushes);
  [[nodiscard]] Long dot(int row, const double* x) const;
  // row / |a| -> unit_
  void fill_unit(int row);
  [[nodiscard]] Long violation(int row) const;  // signed, of an own row

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  const double* x_above_ = nullptr;
  const double* x_ = nullptr;
  double x_scale_ = 1.0;
  int level_ = 0;
  ExtendedPrecisionBasis basis_;  // of rows that take directions away
  NonnegativeLeastSquares balance_;
  std::vector<Push> violation_, step_;
  std::vector<char> pushing_;  // (rows) against the violations
  std::vector<Long> force_, unit_, parts_, free_;
};

}  // namespace hurcules
