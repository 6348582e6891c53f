// A level with rho = 0 whose working set is known from the last solve: one chain instead of
// proximal steps.
//
// The rows in the order  equality rows above | held limits | own equality and violated rows | rows
// that hold the smallest step  are four levels of equality rows without regularisation, so the same
// chain solves them. The answer counts only if it proves itself: limits hold, multipliers are
// positive, violated rows are violated.
#pragma once

#include <vector>

#include "hurcules/solver/chain.hpp"
#include "hurcules/solver/level_problem.hpp"
#include "hurcules/solver/optimality.hpp"
#include "hurcules/solver/row_table.hpp"

namespace hurcules {

// A row of the last solve's working set.
struct KeptRow {
  int held_by = 0;
  int row = 0;  // in the table
  Side side = Side::Upper;
  Role role = Role::Violation;
};

class SettledLevel {
 public:
  void reserve(Index unknowns, Index rows);
  // True when the kept rows of level k are still the right ones; then x is the answer and `held`
  // has its rows (those of the smallest step from begin_norm on).
  bool solve(const RowTable& rows, const LevelProblem& level, int k, const Vector& x_above,
             const std::vector<KeptRow>& kept, Vector& x, std::vector<HeldRow>& held,
             int& begin_norm);

 private:
  enum Group { kAbove, kLimits, kOwn, kSmallest, kGroups };

  void collect(const RowTable& rows, const LevelProblem& level, int k,
               const std::vector<KeptRow>& kept);
  void hold(const RowTable& rows, int i, Side side, double limit);
  // multipliers of the rows of a group and those after it, from the gradient `force_`
  void balance(Group group);
  [[nodiscard]] bool holds(const RowTable& rows, const LevelProblem& level, int k,
                           const Vector& x) const;
  bool keep(const RowTable& rows, const LevelProblem& level, const Vector& x, Group group,
            std::vector<HeldRow>& held) const;

  RowTable table_;
  Chain chain_;
  LevelProblem problem_;
  std::vector<int> original_;  // row of the hierarchy behind each row of the table
  std::vector<Side> side_;
  Vector force_, multiplier_;  // (n), (rows)
};

}  // namespace hurcules
