// A level whose regularisation is nothing, or small against its rows: a primal active set on the
// level as it is, without the least-distance form that loses digits there.
//
// From a feasible point the answer of the held rows (unregularized_step.hpp) is approached until a
// limit stops it; a row that pulls is let go. Started from a set that is right, this is one
// factorisation.
#pragma once

#include <vector>

#include "hurcules/solver/level/budget.hpp"
#include "hurcules/solver/level/level_problem.hpp"
#include "hurcules/solver/optimality/level_record.hpp"
#include "hurcules/solver/problem/candidates.hpp"
#include "hurcules/solver/small_rho/unregularized_step.hpp"

namespace hurcules {

class UnregularizedActiveSet {
 public:
  void reserve(Index unknowns, Index rows);
  // from the next start on: each row is asked for its direction in a large level, too
  void go_by_rows(bool by_rows) { by_rows_ = by_rows; }
  // the last solve did not, in a large level
  [[nodiscard]] bool large() const { return step_.large(); }
  // A level from x_above, of size x_scale, from the point `x` of the rows that will be held, or
  // x_above where `x` breaks a row above; x_above: they are those of the last solve.
  void start(const RowTable& rows, const NullspaceBasis& nullspace, LevelProblem& level,
             Candidates& candidates, const double* x_above, const double* x, double x_scale);
  // holds a row from the beginning
  void hold(int row, Side side, Role role);
  // To the answer x; then `held` has its rows (those of the smallest step from begin_norm on).
  // False when it does not get there.
  bool solve(double rho, Budget& budget, double* x, std::vector<HeldRow>& held, int& begin_norm);

 private:
  [[nodiscard]] double worst_above(double x_scale) const;
  bool hold_violated();
  void hold(RowGroup group, int row, Side side, bool pinned);
  void let_go(RowGroup group, Index i);
  void release();
  // the point that the held rows ask for: target_, and its values
  void answer(double rho);

  [[nodiscard]] bool contradictory() const;

  // Each of these changes the held rows where they are wrong, and says whether it did.
  bool mend_unmet();
  bool advance(Budget& budget);
  bool mend_own();
  bool mend_weak();
  // `fixed`: only those that pull against the violations
  bool drop_negative(Budget& budget, bool fixed);
  // more limits are held than the level leaves directions
  [[nodiscard]] bool crowded() const;

  void keep(double rho, std::vector<HeldRow>& held, int& begin_norm) const;
  [[nodiscard]] double beyond(const GroupedRow& held) const;  // target - limit, outwards
  [[nodiscard]] double allowed(int row) const;

  const RowTable* rows_ = nullptr;
  const LevelProblem* level_ = nullptr;
  Candidates* candidates_ = nullptr;
  const double* x_above_ = nullptr;
  double x_scale_ = 1.0, size_ = 1.0;  // of x_above; of the target, too
  bool remembered_ = false;            // the first rows come without a point of theirs
  bool by_rows_ = false;
  GroupedRows group_;
  std::vector<GroupedRow> ignored_;
  UnregularizedStep step_;
  PaddedVector x_, target_;
};

}  // namespace hurcules
