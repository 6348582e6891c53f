// One level as a least-distance problem around a centre, and the way back to x.
//
// With t the step from the centre in the free directions, e = coordinates of a row, R'R = Lk'Lk +
// rho^2 I:
//     z = (R t_1 / rho, t_2, w)     t_1: directions of the level's own equality rows, t_2: the
//     other free ones,
//                                   w: a slack a / own inequality row, violation = rho w
//     1/2 |violation|^2 + 1/2 rho^2 |t|^2 = 1/2 rho^2 |z - z0|^2 + constant,   z0 = (R^-T Lk' r /
//     rho, 0, 0)
#pragma once

#include "hurcules/solver/chain.hpp"
#include "hurcules/solver/least_distance.hpp"
#include "hurcules/solver/row_table.hpp"

namespace hurcules {

class LevelProblem {
 public:
  void reserve(Index unknowns, Index rows);

  // Level k from the solution x_above of the levels above: fixes what the rows above may not
  // exceed, and the residual.
  void start(const RowTable& rows, const Chain& chain, int level, const Vector& x_above);
  // the regularised least squares of the own equality rows alone, from the centre: x
  void solve_free(const RowTable& rows, const Chain& chain, double rho, const Vector& centre,
                  Vector& x);
  // fills `distance` with all rows that count here; z stands at the centre, own violated rows are
  // held
  void fill(const RowTable& rows, const Chain& chain, double rho, const Vector& centre);
  // The same without own equality directions and slacks, [t_2] alone: the smallest step with all
  // that level k settled fixed. Rows of `settled` (by table number) are equalities.
  void fill_minimum_norm(const RowTable& rows, const Chain& chain, const Vector& x,
                         const Vector& x_above, const std::vector<char>& settled);
  // x of the present z
  void read_x(const Chain& chain, Vector& x);
  // brings the held rows onto their limits where rounding left them off, in x
  void refine(const RowTable& rows, const Chain& chain, Vector& x);

  [[nodiscard]] double lower(int i) const {
    return lower_[i];
  }  // what row i may not fall below here
  [[nodiscard]] double upper(int i) const { return upper_[i]; }
  // own violated rows aside, does x break a row that counts here?
  [[nodiscard]] bool breaks(const RowTable& rows, const Vector& x) const;
  // largest |a| of the level's own rows
  [[nodiscard]] double own_norm() const { return own_norm_; }
  // the multiplier below which a limit does not settle the violation of a level with rho = 0
  [[nodiscard]] double least_settling(double largest_multiplier) const;
  [[nodiscard]] int table_row(int candidate) const { return candidate_row_[candidate]; }
  [[nodiscard]] int candidate(int table_row) const { return row_candidate_[table_row]; }
  [[nodiscard]] bool own(int i) const { return i >= begin_ && i < end_; }
  [[nodiscard]] bool satisfied() const { return satisfied_; }

  LeastDistance distance;

 private:
  // Lk stacked on rho I -> R, and c = first part of the rotated residual; t_1 = R^-1 c
  void factor(const RowTable& rows, const Chain& chain, double rho, const Vector& centre);
  [[nodiscard]] double tolerance(const RowTable& rows, int i, double x_scale,
                                 double target_scale) const;
  void fill_row(const RowTable& rows, const Chain& chain, int i, Index c, double rho);

  int level_ = 0, begin_ = 0, end_ = 0;
  Index first_ = 0, own_ = 0, free_ = 0;  // first free direction, own directions, free directions
  bool satisfied_ = false;
  double rho_ = 0.0, x_scale_ = 1.0, own_norm_ = 0.0;
  bool minimum_norm_ = false;
  Vector centre_, lower_, upper_, c_, t_, change_;
  Matrix stacked_;  // (own rows + own directions, own directions + 1)
  std::vector<int> candidate_row_, row_candidate_, slack_of_;
};

}  // namespace hurcules
