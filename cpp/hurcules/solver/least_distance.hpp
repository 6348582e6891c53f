// A level in the coordinates of the chain: the point nearest to a target, subject to rows.
//
//     min 1/2 |z - target|^2   subject to   lower <= M z <= upper
//
// solved with a working set W of rows held at one side. The rows of W have their own orthogonal
// factor M_W = F V (F lower triangular, V orthonormal rows), so that
//     z = target + V' (u - V target),  F u = limits of W,       multipliers = F^-T (V target - u).
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/solver/solver.hpp"

namespace hurcules {

// A place in the working set, as opposed to the number of a row.
struct ActiveSlot {
  int candidate = 0;  // row of M
  Side side = Side::Upper;
  bool fixed = false;       // an equality of this problem: never dropped
  double multiplier = 0.0;  // >= 0 unless fixed, for  side * M z <= side * limit
};

class LeastDistance {
 public:
  void reserve(Index candidates, Index dimension);
  // a new problem: `rows()`, `target()`, limits and tolerances are then filled by the caller
  void start(Index candidates, Index dimension);

  [[nodiscard]] Index candidates() const { return candidates_; }
  [[nodiscard]] Index dimension() const { return dimension_; }
  [[nodiscard]] double* row(Index c) { return M_.row(c).data(); }
  [[nodiscard]] const double* row(Index c) const { return M_.row(c).data(); }

  Vector target;              // z0 (dimension)
  Vector z;                   // (dimension)
  Vector lower;               // (candidates), -inf when absent
  Vector upper;               // (candidates)
  Vector tolerance;           // (candidates), what counts as broken
  std::vector<char> ignored;  // (candidates), rows without a part here

  // Adds a row at a side. False, and nothing is changed, when it depends on the rows that are held.
  bool add(int candidate, Side side, bool fixed = false);
  void drop(Index slot);
  void clear();
  // no row is broken at z
  [[nodiscard]] bool feasible() const;
  [[nodiscard]] const std::vector<ActiveSlot>& active() const { return active_; }
  [[nodiscard]] bool holds(int candidate) const { return held_[candidate] != 0; }
  [[nodiscard]] bool full() const { return static_cast<Index>(active_.size()) == dimension_; }

  // the minimiser on the working set, and its multipliers
  void solve_on_active();
  // moves z by the least amount that changes each held row by its entry of `change` (slots)
  void correct(Vector& change);
  // r with M_W' r nearest to side * row of the candidate; returns the squared norm of what W does
  // not explain
  double explain(int candidate, Side side, Vector& r);
  // index of the most negative multiplier that may be dropped, or -1
  [[nodiscard]] int most_negative() const;
  // the candidate most broken at z outside W relative to its tolerance, or -1; its side in `side`
  [[nodiscard]] int most_broken(Side& side, double slack) const;
  [[nodiscard]] double value(Index candidate) const;  // M z of one row
  [[nodiscard]] double limit(int candidate, Side side) const {
    return side == Side::Upper ? upper[candidate] : lower[candidate];
  }
  void set_multiplier(Index slot, double value) { active_[slot].multiplier = value; }

  // Primal active set from the feasible z: ends at the minimiser, or when `changes_left` is used up
  // (false).
  bool solve_primal(int& changes, int changes_left);
  // Dual active set (Goldfarb-Idnani) from any working set; `raised` tells that the tolerance had
  // to grow to end.
  bool solve_dual(int& changes, int changes_left, bool& raised);

 private:
  // removes from v its parts along the first `count` rows of V, parts to l; returns |v|
  double project(double* v, double* l, Index count) const;
  int first_blocking(double& step, Side& side) const;
  void drop_negative(int& changes);
  bool raise(int candidate, Side side, int& changes, int changes_left);

  Index candidates_ = 0, dimension_ = 0;
  Matrix M_;      // (candidates, dimension)
  Matrix F_, V_;  // (slots, slots) lower triangular, (slots, dimension)
  Vector u_, direction_, from_, work_, r_;
  std::vector<ActiveSlot> active_;
  std::vector<char> held_;
};

}  // namespace hurcules
