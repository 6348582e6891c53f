// The proof of an answer: how far each level is from its optimality conditions, evaluated on the
// original rows.
//
// With x_k the solution after level k, v the violations of its own rows, mu >= 0 the multipliers of
// held rows:
//     g = rho^2 (x_k - x_{k-1}) + sum v_i a_i + sum mu_w side_w a_w   must vanish on the free
//     directions
// (behind a hand-over, x = B t', it is rho^2 t' + B'f, f the sums above, that must vanish; measured
// is B times it, an error of x; and of a level that gave directions back only the combinations of
// its rows that it keeps may not move: what is proven is the problem with the hand-over)
// and rows above must not have got worse, mu >= 0, and a row with mu > 0 must stand at its limit
// [T 3.4.100-113].
#pragma once

#include <vector>

#include "hurcules/solver/candidates.hpp"
#include "hurcules/solver/chain.hpp"
#include "hurcules/solver/row_table.hpp"
#include "hurcules/solver/solver.hpp"

namespace hurcules {

// what a solved level leaves behind
struct LevelRecord {
  double rho = 0.0;              // that was used
  double asked_rho = 0.0;        // of the level as it came; of levels without an answer, too
  double own_norm = 0.0;         // largest |a| of its rows
  PaddedVector x;                // (n), after this level
  double worsened = 0.0;         // by how much rows above got worse, relative to |a| max(1, |x|)
  int first_held = 0, held = 0;  // its rows in the list of held rows
  int first_norm = 0, norm = 0;  // rows that hold only the smallest step (rho = 0)
};

// What a held row does for its level. Only rho = 0 knows other roles than Violation.
enum class Role : char {
  Violation,     // it takes part in the smallest violation
  SmallestStep,  // it only keeps the step from being smaller
  Idle,          // it is touched and does neither, or it is listed a second time
};

// a row that pushes back in a level's problem
struct HeldRow {
  int row = 0;  // in the table
  Side side = Side::Upper;
  double multiplier = 0.0;
  Role role = Role::Violation;
};

class Optimality {
 public:
  void reserve(Index unknowns, Index rows);
  // Worst relative residual of level k, from x_above and with the values of all candidates there
  // (above) and at record.x (value); x_scale = max(1, |x|). Fills record.worsened.
  double residual(const RowTable& rows, Chain& chain, const Candidates& candidates, int k,
                  const double* x_above, double x_scale, LevelRecord& record,
                  const std::vector<HeldRow>& held);

  // by how much inequality rows above level k got worse, relative to |a|
  [[nodiscard]] double worsened(const RowTable& rows, const Candidates& candidates, int k) const;
  // by how much equality rows above level k (of a level that handed over: what it keeps) moved
  // between x_above and x, relative to |a|
  double moved(const RowTable& rows, const Chain& chain, int k, const double* x_above,
               const double* x);
  // by how much equality rows of levels that were proven, and did not hand over, moved since,
  // relative to |a|; `value`: their values now, by dense row; `last`: the last chain
  [[nodiscard]] double moved_since(const RowTable& rows, const Chain& last, int levels,
                                   const double* value) const;

 private:
  double add_own_rows(const RowTable& rows, const Candidates& candidates, int k, const double* x,
                      double* g);
  double unbalanced_force(Chain& chain, int k, const double* x_above, const double* x, double rho2,
                          double* g);
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
  double norm_residual(const RowTable& rows, Chain& chain, int k, const double* x_above,
                       const LevelRecord& record, const std::vector<HeldRow>& held,
                       const Balance& violations);
  double repeats(const RowTable& rows, const LevelRecord& record, const std::vector<HeldRow>& held,
                 const Balance& violations);

  PaddedVector push_;             // (rows) against the violations
  PaddedVector g_, work_, step_;  // (n)
  PaddedVector violation_;        // (rows)
  PaddedVector settled_;          // (equality rows), values when their level was proven
};

}  // namespace hurcules
