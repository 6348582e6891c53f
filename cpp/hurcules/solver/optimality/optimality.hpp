// The proof of an answer: how far each level is from its optimality conditions, evaluated on the
// original rows.
//
// With x_k the solution after level k, v the violations of its own rows, mu >= 0 the multipliers of
// held rows:
//     g = rho^2 (x_k - x_{k-1}) + sum v_i a_i + sum mu_w side_w a_w   must vanish on the free
//     directions
// (behind a smooth transition, x = B t', it is rho^2 t' + B'f, f the sums above, that must vanish;
// measured is B times it, an error of x; and of a level that gave directions back only the
// combinations of its rows that it keeps may not move: what is proven is the problem with the
// transition) and rows above must not have got worse, mu >= 0, and a row with mu > 0 must stand at
// its limit [T 3.4.100-113].
#pragma once

#include <vector>

#include "hurcules/solver/optimality/level_record.hpp"
#include "hurcules/solver/problem/candidates.hpp"
#include "hurcules/solver/problem/nullspace_basis.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

class Optimality {
 public:
  void reserve(Index unknowns, Index rows);
  // Worst relative residual of level k, from x_above and with the values of all candidates there
  // (above) and at record.x (value); x_scale = max(1, |x|). Fills record.worsened.
  double residual(const RowTable& rows, NullspaceBasis& nullspace, const Candidates& candidates,
                  int k, const double* x_above, double x_scale, LevelRecord& record,
                  const std::vector<HeldRow>& held);

  // by how much inequality rows above level k got worse, relative to |a|
  [[nodiscard]] double worsened(const RowTable& rows, const Candidates& candidates, int k) const;
  // by how much equality rows above level k (of a level that handed over: what it keeps) moved
  // between x_above and x, relative to |a|
  double moved(const RowTable& rows, const NullspaceBasis& nullspace, int k, const double* x_above,
               const double* x);
  // by how much equality rows of levels that were proven, and did not hand over, moved since,
  // relative to |a|; `value`: their values now, by dense row; `last`: the last basis
  [[nodiscard]] double moved_since(const RowTable& rows, const NullspaceBasis& last, int levels,
                                   const double* value) const;

 private:
  double add_own_rows(const RowTable& rows, const Candidates& candidates, int k, const double* x,
                      double* g);
  double unbalanced_force(NullspaceBasis& nullspace, int k, const double* x_above, const double* x,
                          double rho2, double* g);
  // what the held rows do in one level
  struct Forces {
    double scale = 0.0;    // sum mu |a| of rows above
    double largest = 0.0;  // multiplier
    double pull = 0.0;     // the most negative of them
    double apart = 0.0;    // the largest mu times distance from the limit, relative to |a|
  };
  static Forces add_held_rows(const RowTable& rows, const Candidates& candidates, int k,
                              const LevelRecord& record, const std::vector<HeldRow>& held,
                              double* g);
  // of the violations: what is left of it, and the forces that are told from none
  struct Balance {
    double unbalanced, told;
  };
  double norm_residual(const RowTable& rows, NullspaceBasis& nullspace, int k,
                       const double* x_above, const LevelRecord& record,
                       const std::vector<HeldRow>& held, const Balance& violations);
  double repeats(const RowTable& rows, const LevelRecord& record, const std::vector<HeldRow>& held,
                 const Balance& violations);

  PaddedVector push_;             // (rows) against the violations
  PaddedVector g_, work_, step_;  // (n)
  PaddedVector violation_;        // (rows)
  PaddedVector settled_;          // (equality rows), values when their level was proven
};

}  // namespace hurcules
