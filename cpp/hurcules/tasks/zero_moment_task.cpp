#include "hurcules/tasks/zero_moment_task.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

ZeroMomentTask::ZeroMomentTask(std::string name, const Robot& robot,
                               const ZeroMomentTaskOptions& options)
    : Task(std::move(name), options.polygon.rows(), robot),
      polygon_(options.polygon, name_),
      height_(options.height),
      com_(3, robot.size()),
      spin_(3, robot.size()) {
  require(std::isfinite(options.height) && std::isfinite(options.margin),
          "height and margin of task '" + name_ + "' want finite numbers [m]");
  const double g = robot.gravity().norm();
  require(g > 0.0, "task '" + name_ + "' wants a model with gravity");
  if (!options.reference.empty()) reference_ = robot.frame(options.reference);
  lower_.setConstant(options.margin * g);
  upper_.setConstant(std::numeric_limits<double>::infinity());
  require_one_tree(robot, name_);
  ZeroMomentTask::update(robot);
}

void ZeroMomentTask::update(const Robot& robot) {
  require_robot(robot);
  const Skeleton::Pose pose = reference_ ? robot.pose(*reference_) : Skeleton::Pose{};
  const Vector3 g = robot.gravity(), c = robot.com();
  const double m = robot.mass();
  const Vector3 pull = g - robot.com_drift();
  const Vector3 spin = robot.angular_momentum_drift() / m;
  robot.com_jacobian(com_);
  robot.angular_momentum_jacobian(spin_);
  // the reference's z points up or down
  const double up = g.dot(pose.R.col(2)) < 0.0 ? 1.0 : -1.0;
  for (Index i = 0; i < rows(); ++i) {
    const auto corner = polygon_.corners().row(i), n = polygon_.normals().row(i);
    const Vector3 p = pose.p + pose.R * Vector3(corner.x(), corner.y(), height_);
    const Vector3 t = up * (pose.R * Vector3(-n.y(), n.x(), 0.0));  // up x n
    const Vector3 u = t.cross(c - p);
    error_[i] = u.dot(pull) - t.dot(spin);
    const Vector3 turn = t / m;
    jacobian_.row(i) = -u[0] * com_.row(0) - u[1] * com_.row(1) - u[2] * com_.row(2) -
                       (turn[0] * spin_.row(0) + turn[1] * spin_.row(1) + turn[2] * spin_.row(2));
  }
  drift_ = error_;
}

void ZeroMomentTask::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

}  // namespace hurcules
