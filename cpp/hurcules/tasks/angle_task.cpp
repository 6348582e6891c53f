#include "hurcules/tasks/angle_task.hpp"

#include "hurcules/base/error.hpp"
#include "hurcules/tasks/angle.hpp"

namespace hurcules {

AngleTask::AngleTask(std::string name, const Robot& robot, const std::string& frame,
                     const AngleTaskOptions& options)
    : ValueTask(std::move(name), 1, robot, options.kind == AngleKind::Heading),
      kind_(options.kind),
      axis_(options.axis.normalized()),
      frame_(robot.frame(frame)),
      reference_(robot, options.reference),
      rotation_(robot),
      direction_(robot) {
  require(axis_.allFinite() && axis_.norm() > 0.5,
          "axis of task '" + name_ + "' wants to be finite and not zero");
  reference_.require_moved(robot, frame, name_);
  AngleTask::hold(robot);
}

void AngleTask::measure(const Robot& robot) {
  reference_.measure(robot);
  rotation_.measure(robot, frame_);
  reference_.express(rotation_);
  rotation_.direction(axis_, direction_);

  const bool heading = kind_ == AngleKind::Heading;
  const Angle angle = heading ? azimuth(direction_) : elevation(direction_);
  value_[0] = angle.value;
  drift_[0] = angle.drift;
  jacobian_.noalias() = angle.gradient.transpose().lazyProduct(direction_.jacobian);
}

}  // namespace hurcules
