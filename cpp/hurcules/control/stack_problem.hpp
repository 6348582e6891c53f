// A stack as the hierarchy that a controller fills tick by tick: one level of the solver for each
// of the stack, sized once.
//
// A level made of one task that bounds the coordinates becomes simple bounds; a stack has at most
// one such level.
#pragma once

#include <vector>

#include "hurcules/control/stack.hpp"
#include "hurcules/solver/solver.hpp"

namespace hurcules {

class JointLimits;
class LoopLimits;

class StackProblem {
 public:
  // n unknowns
  explicit StackProblem(Index n) : n_(n) {}
  // With `own` these limits come first where the stack names none; `loops`, if it has rows, next to
  // them. `others`: unknowns after those of the tasks, whose columns are left at zero. Throws Error
  // for tasks of another robot and for a second level of limits.
  void set_stack(const Stack& stack, JointLimits* own = nullptr, LoopLimits* loops = nullptr,
                 Index others = 0);

  [[nodiscard]] const Stack& stack() const { return stack_; }
  [[nodiscard]] Hierarchy& hierarchy() { return hierarchy_; }
  [[nodiscard]] const Hierarchy& hierarchy() const { return hierarchy_; }
  // the level of coordinate limits, -1 without one, and its task, null without one
  [[nodiscard]] int bounds_level() const { return bounds_level_; }
  [[nodiscard]] Task* bounds_task() const { return bounds_task_; }
  [[nodiscard]] const JointLimits* joint_limits() const { return joint_limits_; }
  // the same level as the solver has it; only with one
  [[nodiscard]] Level& bounds() { return hierarchy_[static_cast<std::size_t>(bounds_level_)]; }
  [[nodiscard]] const Level& bounds() const {
    return hierarchy_[static_cast<std::size_t>(bounds_level_)];
  }

 private:
  Index n_;
  Stack stack_;
  Hierarchy hierarchy_;
  Task* bounds_task_ = nullptr;
  const JointLimits* joint_limits_ = nullptr;  // the same, when it is this kind of task
  int bounds_level_ = -1;
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

// moves a coordinate (signed distances to its limits) by a step: inside the limits it ends at the
// limit at most, outside it may only lead back
[[nodiscard]] double held_step(double step, double to_lower, double to_upper);

}  // namespace hurcules
