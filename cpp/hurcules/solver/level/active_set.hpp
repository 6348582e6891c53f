// Finds the working set of a level: a primal active set from where the levels above ended.
#pragma once

#include "hurcules/solver/level/budget.hpp"
#include "hurcules/solver/level/working_set.hpp"

namespace hurcules {

class ActiveSet {
 public:
  void reserve(Index unknowns, Index most_rows, Index most_own);
  // A level from x_above. `x_scale` is what rounding in x is relative to.
  void start(const RowTable& rows, LevelProblem& problem, Candidates& candidates, double rho,
             const double* x_above, double x_scale);

  void clear();

  // No limit is in the way of x_free: it is the answer, candidates.value its values.
  [[nodiscard]] bool free_is_feasible();
  // Primal, from x_above, which no limit forbids: feasible all along, monotone. False when
  // `most_changes`, or the budget, are used up; x_feasible() is then the best point so far.
  bool primal(Budget& budget, int most_changes);
  // brings the held rows onto their limits where rounding left them off: x() and candidates.value
  void refine();

  // the optimum without limits; that of the working set; the best point of an interrupted primal
  [[nodiscard]] const double* x_free() const { return x_free_.data(); }
  [[nodiscard]] const double* x() const { return target_.data(); }
  [[nodiscard]] const double* x_feasible() const { return x_.data(); }
  [[nodiscard]] const std::vector<ActiveSlot>& slots() const { return set_.slots(); }

 private:
  // the point of the working set: target x, values, multipliers
  void solve();
  void evaluate();
  // holds the own rows that are violated at x_above
  void hold_violated();
  // nothing here can move the row
  [[nodiscard]] bool lost(const Row& row) const;
  void ignore(const Row& row);
  void restore_ignored();
  [[nodiscard]] double largest_miss(double* change) const;

  struct Ignored {
    Index candidate;
    double lower, upper;
  };

  const double* x_above_ = nullptr;
  const RowTable* rows_ = nullptr;
  LevelProblem* problem_ = nullptr;
  Candidates* candidates_ = nullptr;
  WorkingSet set_;
  Index count_ = 0;                         // of candidates that may count here
  double relative_ = 0.0, absolute_ = 0.0;  // a limit is broken beyond relative |a| + absolute
  PaddedVector x_, x_free_, target_, y_, change_;
  std::vector<Ignored> ignored_;
};

}  // namespace hurcules
