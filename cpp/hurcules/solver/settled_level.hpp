// A level whose regularisation is nothing or next to nothing, when its working set is known: one
// factorisation instead of proximal steps.
//
// In the free directions the rows in the order  held limits | own equality and violated rows |
// limits that hold only the smallest step  are met one after the other: the limits exactly, the
// own rows by least squares, the last with what is left. The answer counts only if it proves
// itself: all limits hold, multipliers are positive, violated rows are violated.
#pragma once

#include <vector>

#include "hurcules/solver/candidates.hpp"
#include "hurcules/solver/chain.hpp"
#include "hurcules/solver/level_problem.hpp"
#include "hurcules/solver/optimality.hpp"

namespace hurcules {

class SettledLevel {
 public:
  void reserve(Index unknowns, Index rows);
  // a level from x_above; then its rows are planned
  void start(const RowTable& rows, const Chain& chain, const LevelProblem& level,
             Candidates& candidates, const double* x_above);
  void plan(int row, Side side, double limit, Role role);
  // True when the planned rows are the right ones; then x is the answer and `held` has its rows
  // (those of the smallest step from begin_norm on).
  bool solve(double rho, double x_scale, double* x, std::vector<HeldRow>& held, int& begin_norm);

 private:
  enum Group { kLimits, kOwn, kSmallest, kGroups };
  struct Planned {
    int row;
    Side side;
    double limit;
    double multiplier;
  };

  void factor();
  // coordinates of the step: limits exactly, own rows by least squares, the rest
  void meet(Group group);
  void least_squares(double rho);
  void step(double* x);
  [[nodiscard]] bool holds(const double* x, double x_scale);
  // multipliers of the limits against the violations, and of all rows against the step
  void balance_violation(double rho, const double* x);
  void balance_step();
  [[nodiscard]] bool keep(double x_scale, const double* x, std::vector<HeldRow>& held,
                          int& begin_norm);
  [[nodiscard]] bool keep_regularized(const double* x, std::vector<HeldRow>& held) const;
  void keep_own(const double* x, std::vector<HeldRow>& held) const;
  [[nodiscard]] Index begin(Group group) const { return group == 0 ? 0 : end_[group - 1]; }
  // directions that a group gave
  [[nodiscard]] Index first(Group group) const { return group == 0 ? 0 : rank_[group - 1]; }

  const RowTable* rows_ = nullptr;
  const Chain* chain_ = nullptr;
  const LevelProblem* level_ = nullptr;
  Candidates* candidates_ = nullptr;
  const double* x_above_ = nullptr;
  std::vector<Planned> planned_[kGroups], all_;
  Index end_[kGroups] = {}, rank_[kGroups] = {};
  OrthogonalFactor factor_;
  Matrix block_;
  PaddedVector norm2_, y_, t_, force_, push_;
};

}  // namespace hurcules
