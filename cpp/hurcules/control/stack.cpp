#include "hurcules/control/stack.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/tasks/force_task.hpp"

namespace hurcules {

namespace {

void check(const StackLevel& level) {
  require(level.limits || !level.tasks.empty(),
          "a level of a stack wants at least one task; '" + level.name + "' has none");
  require(level.rho >= 0.0 && std::isfinite(level.rho),
          "level '" + level.name + "' wants a finite rho >= 0, got " + number_text(level.rho));
  for (const Task* task : level.tasks) {
    require(task != nullptr, "level '" + level.name + "' holds a task that does not exist (null)");
  }
}

void check_limits_first(const std::vector<StackLevel>& levels) {
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const JointLimits* const limits = levels[k].limits;
    if (!limits) continue;
    require(limits != levels.front().limits, "'" + limits->name() + "' stands twice in one stack");
    require(!levels.front().limits, "a stack wants at most one level of coordinate limits");
    throw Error("limits '" + limits->name() + "' come first in a stack, not after '" +
                levels[k - 1].name + "': they hold before all tasks");
  }
}

void check_each_task_once(const std::vector<StackLevel>& levels) {
  std::vector<const Task*> seen;
  for (const StackLevel& level : levels) {
    for (const Task* task : level.tasks) {
      require(std::find(seen.begin(), seen.end(), task) == seen.end(),
              "task '" + task->name() + "' stands twice in one stack");
      seen.push_back(task);
    }
  }
}

}  // namespace

StackLevel::StackLevel(Task& task) : name(task.name()), tasks{&task} {}

StackLevel::StackLevel(JointLimits& joint_limits)
    : name(joint_limits.name()), limits(&joint_limits) {}

StackLevel::StackLevel(std::string level_name, std::vector<Task*> level_tasks, double level_rho)
    : name(std::move(level_name)), tasks(std::move(level_tasks)), rho(level_rho) {
  check(*this);
}

Stack::Stack(std::vector<StackLevel> levels) : levels_(std::move(levels)) {
  for (const StackLevel& level : levels_) check(level);
  check_limits_first(levels_);
  check_each_task_once(levels_);
}

std::vector<Task*> Stack::tasks() const {
  std::vector<Task*> all;
  for (const StackLevel& level : levels_)
    all.insert(all.end(), level.tasks.begin(), level.tasks.end());
  return all;
}

bool Stack::holds(const Task& task) const {
  const std::vector<Task*> all = tasks();
  return std::find(all.begin(), all.end(), &task) != all.end();
}

std::string Stack::text() const {
  std::string text;
  for (const StackLevel& level : levels_) text += (text.empty() ? "" : " < ") + level.name;
  return text;
}

void require_period(const Stack& stack, double dt) {
  for (const Task* const task : stack.tasks()) {
    const auto* const force = dynamic_cast<const ForceTask*>(task);
    require(!force || std::abs(force->options().gains.dt - dt) <= 1e-9 * dt,
            "task '" + task->name() + "' reckons with a period of " +
                (force ? number_text(force->options().gains.dt) : "") + " s, its controller has " +
                number_text(dt) + " s: ForceGains(dt=...)");
  }
}

StackLevel operator+(const StackLevel& a, const StackLevel& b) {
  require(!a.limits && !b.limits, "limits of the coordinates stand alone on their level; '" +
                                      a.name + "' and '" + b.name + "' cannot be one level");
  require(a.rho == b.rho, "levels '" + a.name + "' and '" + b.name +
                              "' have different rho and cannot be one level");
  std::vector<Task*> tasks = a.tasks;
  tasks.insert(tasks.end(), b.tasks.begin(), b.tasks.end());
  return {a.name + " + " + b.name, std::move(tasks), a.rho};
}

Stack operator<(const StackLevel& first, const StackLevel& second) {
  return Stack({first, second});
}

Stack operator<(const Stack& stack, const StackLevel& next) {
  std::vector<StackLevel> levels = stack.levels();
  levels.push_back(next);
  return Stack(std::move(levels));
}

}  // namespace hurcules
