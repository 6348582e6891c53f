// One level as a least-distance problem, and the way back to x.
//
// With t the step from x_above in the free directions, e = coordinates of a row, R'R = Lk'Lk +
// rho^2 I, and x_free the optimum of the level's equality rows alone:
//     y = (0, R (t_1 - t_free) / rho, t_2, w)
//     t_1: directions of the level's own equality rows, t_2: the other free ones,
//     w: a slack an own inequality row, violation = rho w
//     0: `lead` zeros, and zeros before w, so that coordinates stand in y as they do in the basis
//     1/2 |violation|^2 + 1/2 rho^2 |t|^2 = 1/2 rho^2 |y|^2 + constant
// A row a x becomes m y with m = (0, rho e_1 R^-1, e_2, rho at its own slack).  [T 3.3.38]
#pragma once

#include "hurcules/base/types.hpp"
#include "hurcules/solver/kernels/padded.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

class LevelProblem {
 public:
  void reserve(Index unknowns, Index rows, Index most_own);
  // level k in the free directions of the basis, from the answer of the levels above
  void start(const RowTable& rows, const NullspaceBasis& nullspace, int level,
             const double* x_above);
  // the optimum of the own equality rows alone, from where the levels above ended
  void solve_free(double rho, double* x_free);
  // The same as a step in the own directions: R and c, the least squares of the own equality rows.
  // Once for every rho.
  void factor(double rho);

  [[nodiscard]] int level() const { return level_; }
  [[nodiscard]] Index first() const { return first_; }  // first free direction
  [[nodiscard]] Index own() const { return own_; }      // own directions
  [[nodiscard]] Index free() const { return free_; }    // free directions
  [[nodiscard]] Index dimension() const { return free_ + slacks_; }
  [[nodiscard]] Index width() const { return body_ + slacks_; }  // of y, with its zeros
  [[nodiscard]] bool has_slacks() const { return slacks_ > 0; }
  [[nodiscard]] bool has_slack(const Row& row) const { return slacks_ > 0 && row.level == level_; }
  // largest part of x_free - x_above in units of y: what rounding is relative to
  [[nodiscard]] double target_size() const { return target_size_; }
  // largest |a| of the own rows
  [[nodiscard]] double own_norm() const { return own_norm_; }
  // the multiplier below which a limit does not settle the violation of a level with rho = 0
  [[nodiscard]] double least_settling(double largest_multiplier, double x_scale) const;
  [[nodiscard]] Index equalities() const { return equalities_; }
  // coordinates of own equality row i in the own directions, and what it asks for of the step
  [[nodiscard]] const double* equality_row(Index i) const {
    return nullspace_->equality_coordinates(rows_->equalities(level_) + i) + first_;
  }
  [[nodiscard]] double equality_rest(Index i) const { return r_[i]; }
  // Row j of R and its entry of c after factor(rho); what stands left of the diagonal is no part of
  // it.
  [[nodiscard]] const double* condensed_row(Index j) const { return R_.data() + j * own_; }
  [[nodiscard]] double condensed_target(Index j) const { return c_[j]; }
  // the own equality rows are met at x_above, to rounding
  [[nodiscard]] bool equalities_met(double x_scale) const;

  // m of an inequality row times sign, all of width() and zeros behind
  void image(const Row& row, double sign, double* m) const;
  // a row has no part in the free directions, only rounding
  [[nodiscard]] bool lost(const Row& row) const;
  // x = x_free + what y moves
  void step(const double* y, const double* x_free, double* x);
  // x = x_above + the step of factor(rho) + what y moves
  void step(const double* y, double* x);
  // by how much the step of factor(rho) moves the row whose image is m: e_1 t = m_1 c / rho
  [[nodiscard]] double way_to_free(const double* m) const {
    double sum = 0.0;
    for (Index j = 0; j < own_; ++j) sum += m[lead_ + j] * c_[j];
    return sum * per_rho_;
  }
  // rho w of an own inequality row
  [[nodiscard]] double slack(const Row& row, const double* y) const {
    return rho_ * y[body_ + slack_of(row)];
  }

 private:
  [[nodiscard]] Index slack_of(const Row& row) const;
  void find_residual(const double* x);
  [[nodiscard]] double largest_coordinate() const;
  template <int fixed>
  void factor_by_cholesky();
  void factor_by_householder();
  // t = R^-1 scale b
  void solve_triangular(double scale, const double* b);
  template <int fixed>
  void solve_triangular(double scale, const double* b);
  // own = R^-T scale own, in place
  template <int fixed>
  void solve_transposed(double scale, double* own) const;

  const RowTable* rows_ = nullptr;
  const NullspaceBasis* nullspace_ = nullptr;
  const double* x_above_ = nullptr;
  int level_ = 0;
  Index first_ = 0, own_ = 0, free_ = 0, slacks_ = 0, equalities_ = 0;
  Index lead_ = 0, body_ = 0;
  double rho_ = 0.0, per_rho_ = 0.0, target_size_ = 0.0, own_norm_ = 0.0;
  PaddedVector R_;               // (own, own) upper triangular, rows own_ apart
  PaddedRows stacked_;           // Householder's block
  PaddedVector inverse_, c_;     // 1 / diagonal; R^-T Lk' r
  PaddedVector t_, t_free_, r_;  // coefficients; residuals
  PaddedVector work_;
};

}  // namespace hurcules
