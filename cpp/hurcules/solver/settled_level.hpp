// A level whose regularisation is nothing, or small against its rows: a primal active set on the
// level as it is, without the least-distance form that loses digits there.
//
// In the free directions the held rows in the order
//     limits that push against the level | own equality and violated rows | limits that hold only
//     the smallest step
// are met one after the other: the limits exactly, the own rows by least squares, the last with
// what is left. From a feasible point the answer of the held rows is approached until a limit
// stops it; a row that pulls is let go. Started from a set that is right, this is one
// factorisation.
#pragma once

#include <vector>

#include "hurcules/solver/budget.hpp"
#include "hurcules/solver/candidates.hpp"
#include "hurcules/solver/chain.hpp"
#include "hurcules/solver/level_problem.hpp"
#include "hurcules/solver/optimality.hpp"

namespace hurcules {

class SettledLevel {
 public:
  void reserve(Index unknowns, Index rows);
  // A level from x_above, of size x_scale, from the point `x` of the rows that will be held, or
  // x_above where `x` breaks a row above; x_above: they are those of the last solve.
  void start(const RowTable& rows, const Chain& chain, const LevelProblem& level,
             Candidates& candidates, const double* x_above, const double* x, double x_scale);
  // holds a row from the beginning
  void hold(int row, Side side, Role role);
  // To the answer x; then `held` has its rows (those of the smallest step from begin_norm on).
  // False when it does not get there.
  bool solve(double rho, Budget& budget, double* x, std::vector<HeldRow>& held, int& begin_norm);

 private:
  enum Group { kLimits, kOwn, kSmallest, kGroups };
  struct Held {
    int row;
    Side side;
    double limit;
    double lower, upper;  // what the row allows when it is let go
    double multiplier;
    bool pinned;  // it came back from the last group once
  };

  [[nodiscard]] double worst_above(double x_scale) const;
  bool hold_violated();
  void hold(Group group, int row, Side side, bool pinned);
  void let_go(Group group, Index i);
  void release();
  void gather();  // groups -> all_
  // the step that the held rows ask for: target_, its values, multipliers
  void answer(double rho);
  void factor();
  double own_rank(double& weakest, Index& seen);
  void meet(Group group);
  void least_squares(double rho);
  void add_smallest(double rho, Index& count);
  void step();
  void balance_violation(double rho);
  void balance_step();

  [[nodiscard]] bool contradictory() const;

  // Each of these changes the held rows where they are wrong, and says whether it did.
  bool mend_unmet();
  bool advance(Budget& budget);
  bool mend_own();
  bool mend_weak();
  bool drop_negative(Budget& budget);

  void keep(double rho, std::vector<HeldRow>& held, int& begin_norm) const;
  [[nodiscard]] double beyond(const Held& held) const;  // target - limit, outwards
  [[nodiscard]] double allowed(int row) const;
  [[nodiscard]] Index begin(Group group) const { return group == 0 ? 0 : end_[group - 1]; }
  // directions that a group gave
  [[nodiscard]] Index first(Group group) const { return group == 0 ? 0 : rank_[group - 1]; }

  const RowTable* rows_ = nullptr;
  const Chain* chain_ = nullptr;
  const LevelProblem* level_ = nullptr;
  Candidates* candidates_ = nullptr;
  const double* x_above_ = nullptr;
  double x_scale_ = 1.0, size_ = 1.0;  // of x_above; of the target, too
  double limits_rank_ = 0.0;           // what is rounding of an own row outside the limits
  bool remembered_ = false;            // the first rows come without a point of theirs
  std::vector<Held> group_[kGroups], all_, ignored_;
  Index end_[kGroups] = {}, rank_[kGroups] = {};
  OrthogonalFactor factor_;
  Matrix block_;
  PaddedVector norm2_, y_, t_, force_, push_, x_, target_;
};

}  // namespace hurcules
