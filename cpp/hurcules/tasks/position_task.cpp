#include "hurcules/tasks/position_task.hpp"

namespace hurcules {

PositionTask::PositionTask(std::string name, const Robot& robot, const std::string& frame,
                           PositionTaskOptions options)
    : PointTask(std::move(name), robot, std::move(options)), frame_(robot.frame(frame)) {
  reference().require_moved(robot, frame, name_);
  PositionTask::hold(robot);
}

}  // namespace hurcules
