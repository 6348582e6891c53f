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
  drifts_.clear();
  for (const StackLevel& level : stack.levels()) {
    tasks_.emplace_back();
    Index rows = 0;
    for (const Task* task : level.tasks) {
      tasks_.back().push_back(copy_of(*task));
      copy_memory(*task, *tasks_.back().back(), scratch_);  // so that it has grown
      rows += task->rows();
    }
    drifts_.push_back(Vector::Zero(rows));
  }
}

void SaddleProbe::look_at(const Robot& robot, const Stack& stack) {
  looked_at_ = &robot;
  stack_ = &stack;
  stands_there_ = false;
}

bool SaddleProbe::move(const Vector& u, std::size_t levels) {
  if (!u.allFinite()) return false;  // a task measured no numbers; the solver will refuse them
  if (!stands_there_) {
    robot_.set_qpos(looked_at_->qpos());
    if (robot_.support() != looked_at_->support()) robot_.stand_on(looked_at_->support());
    copy_targets(*stack_, tasks_, scratch_);
    stands_there_ = true;
  }
  robot_.set_velocity(u);
  for (std::size_t k = 0; k < levels; ++k) {
    Index row = 0;
    for (const auto& task : tasks_[k]) {
      const Index rows = task->rows();
      if (!task->is_limit()) {
        task->update(robot_);
        drifts_[k].segment(row, rows) = task->weights().cwiseProduct(task->drift());
      }
      row += rows;
    }
  }
  return true;
}

}  // namespace hurcules
