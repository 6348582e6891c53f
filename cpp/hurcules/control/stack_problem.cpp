#include "hurcules/control/stack_problem.hpp"

#include <limits>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/tasks/joint_ranges.hpp"

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

Stack with_limits(const Stack& stack, JointLimits& limits, JointRanges* ranges) {
  std::vector<StackLevel> levels = stack.levels();
  if (levels.empty() || !levels.front().limits) levels.insert(levels.begin(), StackLevel(limits));
  if (ranges && ranges->rows() > 0) levels.insert(levels.begin() + 1, StackLevel(*ranges));
  return Stack(std::move(levels));
}

std::vector<Index> rows_of(const Stack& stack) {
  std::vector<Index> rows;
  for (const Task* task : stack.tasks()) rows.push_back(task->rows());
  return rows;
}

Level sized_level(const StackLevel& source, Index n) {
  Index rows = source.limits ? n : 0;
  for (const Task* task : source.tasks) rows += task->rows();
  Level level;
  level.bounds = source.limits != nullptr;
  level.rho = level.bounds ? 0.0 : source.rho;
  level.lower = Vector::Constant(rows, -kNone);
  level.upper = Vector::Constant(rows, kNone);
  if (!level.bounds) level.A = Matrix::Zero(rows, n);
  return level;
}

void require_coordinates(const std::string& name, Index came, Index wanted) {
  require(came == wanted, name + " is for " + std::to_string(came) +
                              " coordinates, the robot has " + std::to_string(wanted));
}

}  // namespace

void StackProblem::set_stack(const Stack& asked, JointLimits* own, JointRanges* ranges,
                             Index others) {
  const Stack stack = own ? with_limits(asked, *own, ranges) : asked;
  Hierarchy hierarchy;
  for (const StackLevel& level : stack.levels()) {
    if (level.limits) require_coordinates("'" + level.name + "'", level.limits->size(), n_);
    for (const Task* task : level.tasks)
      require_coordinates("task '" + task->name() + "'", task->jacobian().cols(), n_);
    hierarchy.push_back(sized_level(level, n_ + others));
  }
  stack_ = stack;
  hierarchy_ = std::move(hierarchy);
  limits_ = stack_.levels().empty() ? nullptr : stack_.levels().front().limits;
}

bool StackProblem::asked_for(const Stack& stack) const {
  return !stack.levels().empty() && stack == asked_ && rows_of(stack) == asked_rows_;
}

void StackProblem::note_asked(const Stack& stack) {
  asked_ = stack;
  asked_rows_ = rows_of(stack);
}

}  // namespace hurcules
