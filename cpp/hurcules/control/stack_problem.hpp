// A stack as the hierarchy that a controller fills tick by tick: one level of the solver for each
// of the stack, sized once.
//
// The limits of the coordinates become simple bounds.
#pragma once

#include <algorithm>
#include <vector>

#include "hurcules/control/stack.hpp"
#include "hurcules/solver/solver.hpp"

namespace hurcules {

class JointRanges;

class StackProblem {
 public:
  // n unknowns
  explicit StackProblem(Index n) : n_(n) {}
  // With `own` these limits come first where the stack names none; `ranges`, if it has rows, next to
  // them. `others`: unknowns after those of the tasks, whose columns are left at zero. Throws Error
  // for tasks and limits of another robot.
  void set_stack(const Stack& stack, JointLimits* own = nullptr, JointRanges* ranges = nullptr,
                 Index others = 0);
  // it is for this stack already: `note_asked` of the same, with as many rows
  [[nodiscard]] bool asked_for(const Stack& stack) const;
  void note_asked(const Stack& stack);

  [[nodiscard]] const Stack& stack() const { return stack_; }
  [[nodiscard]] Hierarchy& hierarchy() { return hierarchy_; }
  [[nodiscard]] const Hierarchy& hierarchy() const { return hierarchy_; }
  // the coordinate limits that hold, null where none do; their level is the first, else -1
  [[nodiscard]] JointLimits* limits() { return limits_; }
  [[nodiscard]] const JointLimits* limits() const { return limits_; }
  [[nodiscard]] int bounds_level() const { return limits_ ? 0 : -1; }
  // the same level as the solver has it; only with limits
  [[nodiscard]] Level& bounds() { return hierarchy_.front(); }
  [[nodiscard]] const Level& bounds() const { return hierarchy_.front(); }

 private:
  Index n_;
  Stack asked_, stack_;
  std::vector<Index> asked_rows_;
  Hierarchy hierarchy_;
  JointLimits* limits_ = nullptr;
};

// Which coordinates are held back by their position limits: -1, 0, 1 each. `is_limit` says whether
// a side of the bounds (row, upper?) is set by the position limit.
template <class IsLimit>
void find_held(const Solution& solution, int bounds_level, const IsLimit& is_limit,
               Eigen::VectorXi& held) {
  held.setZero();
  for (const ActiveRow& active : solution.working_set) {
    const bool upper = active.side == Side::Upper;
    if (active.level == bounds_level && active.row < held.size() &&
        is_limit(static_cast<std::size_t>(active.row), upper))
      held[active.row] = upper ? 1 : -1;
  }
}

// each value within the interval of its coordinate; not where a limit is no number
template <class Interval>
void hold_within(const std::vector<Interval>& intervals, VectorRef values) {
  for (Index i = 0; i < values.size(); ++i) {
    const Interval& interval = intervals[static_cast<std::size_t>(i)];
    if (interval.lower <= interval.upper)
      values[i] = std::clamp(values[i], interval.lower, interval.upper);
  }
}

}  // namespace hurcules
