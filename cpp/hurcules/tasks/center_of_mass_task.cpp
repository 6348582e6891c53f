#include "hurcules/tasks/center_of_mass_task.hpp"

#include "hurcules/robot/trees.hpp"

namespace hurcules {

CenterOfMassTask::CenterOfMassTask(std::string name, const Robot& robot,
                                   CenterOfMassTaskOptions options)
    : PointTask(std::move(name), robot, std::move(options)) {
  require_one_tree(robot, name_);
  max_speed_ = 0.3;
  CenterOfMassTask::hold(robot);
}

}  // namespace hurcules
