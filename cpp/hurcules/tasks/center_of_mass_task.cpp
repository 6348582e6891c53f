#include "hurcules/tasks/center_of_mass_task.hpp"

namespace hurcules {

CenterOfMassTask::CenterOfMassTask(std::string name, const Robot& robot,
                                   CenterOfMassTaskOptions options)
    : PointTask(std::move(name), robot, std::move(options)) {
  CenterOfMassTask::hold(robot);
}

}  // namespace hurcules
