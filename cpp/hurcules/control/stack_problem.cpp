#include "hurcules/control/stack_problem.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/tasks/joint_limits.hpp"
#include "hurcules/tasks/loop_limits.hpp"

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

bool is_bounds(const StackLevel& level) {
  return level.tasks.size() == 1 && level.tasks.front()->bounds_coordinates();
}

Stack with_limits(const Stack& stack, JointLimits& limits, LoopLimits* loops) {
  std::vector<StackLevel> levels = stack.levels();
  auto bounds = std::find_if(levels.begin(), levels.end(), is_bounds);
  if (bounds == levels.end()) bounds = levels.insert(levels.begin(), StackLevel(limits));
  if (loops && loops->rows() > 0) levels.insert(bounds + 1, StackLevel(*loops));
  return Stack(std::move(levels));
}

Level sized_level(const StackLevel& source, Index n) {
  Index rows = 0;
  for (const Task* task : source.tasks) rows += task->rows();
  Level level;
  level.bounds = is_bounds(source);
  if (level.bounds) rows = n;
  level.rho = level.bounds ? 0.0 : source.rho;
  level.lower = Vector::Constant(rows, -kNone);
  level.upper = Vector::Constant(rows, kNone);
  if (!level.bounds) level.A = Matrix::Zero(rows, n);
  return level;
}

}  // namespace

void StackProblem::set_stack(const Stack& asked, JointLimits* own, LoopLimits* loops,
                             Index others) {
  const Stack stack = own ? with_limits(asked, *own, loops) : asked;
  Hierarchy hierarchy;
  Task* bounds_task = nullptr;
  int bounds_level = -1;
  for (const StackLevel& level : stack.levels()) {
    for (const Task* task : level.tasks) {
      require(task->jacobian().cols() == n_,
              "task '" + task->name() + "' is for " + std::to_string(task->jacobian().cols()) +
                  " coordinates, the robot has " + std::to_string(n_));
    }
    if (is_bounds(level)) {
      require(bounds_task == nullptr, "a stack wants at most one level of coordinate limits");
      require(level.tasks.front()->rows() == n_,
              "task '" + level.tasks.front()->name() + "' wants one row a coordinate");
      bounds_task = level.tasks.front();
      bounds_level = static_cast<int>(hierarchy.size());
    }
    hierarchy.push_back(sized_level(level, n_ + others));
  }
  stack_ = stack;
  hierarchy_ = std::move(hierarchy);
  bounds_task_ = bounds_task;
  joint_limits_ = dynamic_cast<const JointLimits*>(bounds_task);
  bounds_level_ = bounds_level;
}

double held_step(double step, double to_lower, double to_upper) {
  return std::clamp(step, std::min(to_lower, 0.0), std::max(to_upper, 0.0));
}

}  // namespace hurcules
