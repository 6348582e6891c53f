#include "hurcules/control/saddle_probe.hpp"

namespace hurcules {

namespace {

using TasksOfLevels = std::vector<std::vector<std::unique_ptr<Task>>>;

// of all tasks that are no limits: those have much to copy, and are hardly ever asked for
void copy_targets(const Stack& stack, const TasksOfLevels& copies, std::vector<double>& scratch) {
  for (std::size_t k = 0; k < copies.size(); ++k) {
    for (std::size_t i = 0; i < copies[k].size(); ++i) {
      const Task& source = *stack.levels()[k].tasks[i];
      if (!source.is_limit()) copy_memory(source, *copies[k][i], scratch);
    }
  }
}

}  // namespace

SaddleProbe::SaddleProbe(const Robot& robot) : robot_(robot.model(), robot.coordinate_names()) {}

void SaddleProbe::set_stack(const Stack& stack) {
  tasks_.clear();
  for (const StackLevel& level : stack.levels()) {
    tasks_.emplace_back();
    for (const Task* task : level.tasks) {
      tasks_.back().push_back(copy_of(*task));
      copy_memory(*task, *tasks_.back().back(), scratch_);  // so that it has grown
    }
  }
}

void SaddleProbe::look_at(const Robot& robot, const Stack& stack) {
  looked_at_ = &robot;
  stack_ = &stack;
  stands_there_ = false;
}

double SaddleProbe::growth(std::size_t k, const Level& level, const Vector& u, double gain) {
  if (!u.allFinite()) return 0.0;  // a task measured no numbers; the solver will refuse them
  if (!stands_there_) {
    robot_.set_qpos(looked_at_->qpos());
    if (robot_.support() != looked_at_->support()) robot_.stand_on(looked_at_->support());
    copy_targets(*stack_, tasks_, scratch_);
    stands_there_ = true;
  }
  robot_.set_velocity(u);
  double sum = 0.0;
  Index row = 0;
  for (std::size_t i = 0; i < tasks_[k].size(); ++i) {
    const Task& source = *stack_->levels()[k].tasks[i];
    Task& task = *tasks_[k][i];
    if (source.is_limit()) copy_memory(source, task, scratch_);
    task.update(robot_);
    for (Index j = 0; j < task.rows(); ++j, ++row) {
      if (level.lower[row] != level.upper[row]) continue;
      const double rate = level.A.row(row).dot(u);
      sum += source.weights()[j] * task.drift()[j] * level.lower[row] - gain * rate * rate;
    }
  }
  return sum;
}

}  // namespace hurcules
