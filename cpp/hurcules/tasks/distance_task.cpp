#include "hurcules/tasks/distance_task.hpp"

#include <limits>

#include "hurcules/base/error.hpp"

namespace hurcules {

DistanceTask::DistanceTask(std::string name, const Robot& robot, const DistanceTaskOptions& options)
    : Task(std::move(name), static_cast<Index>(options.pairs.size()), robot),
      distances_(robot, options.pairs, options.most) {
  require(rows() > 0, "task '" + name_ + "' wants at least one pair of bodies");
  require(
      options.margin < options.most,  // also for a number that is none
      "margin of task '" + name_ + "' wants to be below the largest distance that it looks for");
  lower_.setConstant(options.margin);
  upper_.setConstant(std::numeric_limits<double>::infinity());
  max_speed_ = 0.5;
  DistanceTask::update(robot);
}

void DistanceTask::update(const Robot& robot) {
  require_robot(robot);
  distances_.measure(robot, error_, jacobian_);
}

void DistanceTask::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

}  // namespace hurcules
