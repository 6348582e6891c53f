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

#include <span>
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
  // The same in the coordinates of the basis, which is complete: at a tenth of the cost, but no
  // more exact than double, so that the multipliers are still to be proven. False where own
  // inequality rows are violated.
  bool find_in_basis(const RowTable& rows, const NullspaceBasis& nullspace, int k,
                     const double* x_above, double x_scale, const LevelRecord& record);
  // The rows with their multipliers, those of the smallest step from begin_norm on. What `found`
  // had as settling the violation still does, be its push no more than rounding.
  void keep(std::span<const HeldRow> found, std::vector<HeldRow>& held, int& begin_norm);

 private:
  using Long = long double;
  static constexpr Index kNoBasis = -1;
  struct Push {
    int row;
    Side side;
    Long left;    // part of the row outside the basis
    Long weight;  // of the row at length one
  };

  void start(const RowTable& rows, const NullspaceBasis& nullspace, int k, const double* x_above,
             double x_scale, const LevelRecord& record);
  // vectors are coordinates in the free directions from `first` on
  void use_directions(Index first);
  void balance_in_basis(double size, std::vector<Push>& pushes);
  void find_step();
  [[nodiscard]] bool violated() const;
  void use_equalities(Index first, Index end);
  // rho^2 t + sum v_i a_i of the own rows -> force_; the size of what is in it
  Long own_forces(double rho);
  void settle_violated();
  void push_limits(int first, int end, bool above, std::vector<Push>& pushes);
  void push(int row, Side side, std::vector<Push>& pushes);
  // what of v the pushes do not balance, relative to `scale`
  double balance(const Long* v, Long scale, std::vector<Push>& pushes);
  [[nodiscard]] Long dot(int row, const double* x) const;
  // row / |a| -> unit_, or its coordinates
  void fill_unit(int row);
  void fill_coordinates(const Row& row);
  [[nodiscard]] Long violation(int row) const;  // signed, of an own row

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  const double* x_above_ = nullptr;
  const double* x_ = nullptr;
  double x_scale_ = 1.0;
  int level_ = 0;
  Index columns_ = 0;       // of the vectors
  Index first_ = kNoBasis;  // direction that they begin with, where they are coordinates
  ExtendedPrecisionBasis basis_;  // of rows that take directions away
  NonnegativeLeastSquares balance_;
  std::vector<Push> violation_, step_;
  enum Does : char { kNothing, kSettled, kPushes };
  std::vector<Does> does_;  // (rows) against the violations
  std::vector<Long> force_, unit_, parts_, free_;
};

}  // namespace hurcules
