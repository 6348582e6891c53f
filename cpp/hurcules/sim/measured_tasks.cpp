#include "hurcules/sim/measured_tasks.hpp"

#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

MeasuredTasks::MeasuredTasks(const WholeBodyController& controller)
    : fresh_(controller.tasks().size(), false) {
  for (const Task* const task : controller.tasks()) {
    planned_.push_back(task);
    own_.push_back(copy_of(*task));
    measured_.push_back(own_.back().get());
  }
}

const Task& MeasuredTasks::at(std::size_t number, const Robot& world) {
  if (number >= own_.size())
    throw Error("a simulation measures " + std::to_string(own_.size()) +
                " tasks, there is no number " + std::to_string(number));
  Task& task = *own_[number];
  if (!fresh_[number]) {
    copy_memory(*planned_[number], task, scratch_);
    task.update(world);
    fresh_[number] = true;
  }
  return task;
}

void MeasuredTasks::measure(const Robot& world) {
  for (std::size_t i = 0; i < own_.size(); ++i) (void)at(i, world);
}

}  // namespace hurcules
