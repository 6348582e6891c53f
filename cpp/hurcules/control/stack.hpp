// Tasks by priority, written as the thesis writes it:  Stack stack = joint < hpos < hpitch < pel <
// gaze;
//
// `a < b`: a comes before b. `a + b`: on one level. Limits of the coordinates (joint) are no task:
// named, they come first and take the place of the controller's own. The stack points at tasks and
// limits; whoever made them keeps them.
#pragma once

#include <string>
#include <vector>

#include "hurcules/control/joint_limits.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct StackLevel {
  StackLevel(Task& task);           // implicit on purpose: a task alone is a level
  StackLevel(JointLimits& limits);  // the same
  StackLevel(std::string name, std::vector<Task*> tasks, double rho = kDefaultRho);

  static constexpr double kDefaultRho = 0.1;  // [T §4.3]

  std::string name;
  std::vector<Task*> tasks;
  JointLimits* limits = nullptr;  // a level of limits; it has no tasks
  double rho = kDefaultRho;

  // the same tasks, not such as are alike
  bool operator==(const StackLevel& other) const = default;
};

class Stack {
 public:
  Stack() = default;
  explicit Stack(std::vector<StackLevel> levels);
  [[nodiscard]] const std::vector<StackLevel>& levels() const { return levels_; }
  [[nodiscard]] std::vector<Task*> tasks() const;  // of all levels, in their order
  [[nodiscard]] bool holds(const Task& task) const;
  [[nodiscard]] std::string text() const;  // "joint < hpos < hpitch"
  bool operator==(const Stack& other) const = default;

 private:
  std::vector<StackLevel> levels_;
};

// throws Error for a force task that reckons with another period than the controller's dt [s]
void require_period(const Stack& stack, double dt);

[[nodiscard]] StackLevel operator+(const StackLevel& a, const StackLevel& b);
[[nodiscard]] Stack operator<(const StackLevel& first, const StackLevel& second);
[[nodiscard]] Stack operator<(const Stack& stack, const StackLevel& next);

}  // namespace hurcules
