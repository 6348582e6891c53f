#include "hurcules/control/track_drive.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

// of the robot itself: where it was attached to a model its names may have a prefix
JointActuator find(const Robot& robot, const std::vector<JointActuator>& all,
                   const std::string& joint) {
  std::vector<std::string> names;
  for (const JointActuator& one : all) {
    if (!joint_in_own_tree(robot, one.joint_id)) continue;
    if (one.joint.ends_with(joint)) return one;
    names.push_back(one.joint);
  }
  throw Error(unknown_name("belt with a drive", joint, names));
}

// the track axle, y, is level however the legs are folded: forward is at right angles to it
Eigen::Vector2d forward_of(const Matrix3& R) {
  return Eigen::Vector2d(R(1, 1), -R(0, 1)).normalized();
}

}  // namespace

TrackDrive::TrackDrive(const Robot& robot, const TrackDriveOptions& options)
    : controller_(options.drive),
      root_qpos_(robot.root_qpos()),
      root_dof_(robot.root_dof()),
      qpos_size_(robot.qpos().size()) {
  const std::vector<JointActuator> all = joint_actuators(robot);
  left_ = find(robot, all, options.left);
  right_ = find(robot, all, options.right);
  require(root_qpos_ >= 0, "a robot that drives wants a free joint at its root");
  dofs_ = std::max<Index>({root_dof_ + 6, left_.dof + 1, right_.dof + 1});
}

DriveState TrackDrive::measure(const RobotState& state) const {
  const double* const q = state.qpos.data() + root_qpos_;
  const double* const v = state.qvel.data() + root_dof_;
  const Matrix3 R = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).toRotationMatrix();
  const Eigen::Vector2d forward = forward_of(R);
  DriveState measured;
  measured.left = state.qvel[left_.dof];
  measured.right = state.qvel[right_.dof];
  // of the free joint: velocity in the world, rates in the body
  measured.yaw_rate = R.row(2).dot(Vector3(v[3], v[4], v[5]));
  // along the ground, as the belts run: on a slope it rises with the way; steeper than 45 degrees is
  // no driving but a fall
  const double ahead = forward.dot(Eigen::Vector2d(v[0], v[1]));
  measured.speed =
      std::copysign(std::hypot(ahead, std::min(std::abs(v[2]), std::abs(ahead))), ahead);
  measured.pose = {q[0], q[1], std::atan2(forward.y(), forward.x())};
  return measured;
}

void TrackDrive::follow(const RobotState& state) {
  controller_.compute(measure(state));
  braked_ = controller_.braked();
}

void TrackDrive::compute(const RobotState& state, VectorRef ctrl) {
  const DriveTorques torques = controller_.compute(measure(state));
  ctrl[left_.actuator] = left_.control(torques.left, 0.0, 0.0);
  ctrl[right_.actuator] = right_.control(torques.right, 0.0, 0.0);
  braked_ = controller_.braked();
}

void TrackDrive::roll(VectorRef qpos, const Vector3& centre, double dt) const {
  const DriveCommand now = controller_.reference();
  auto root = qpos.segment<7>(root_qpos_);
  const Eigen::Quaterniond attitude(root[3], root[4], root[5], root[6]);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(now.yaw_rate * dt, Vector3::UnitZ()));
  const Eigen::Quaterniond turned = (turn * attitude).normalized();
  root.head<3>() = centre + turn * (Vector3(root.head<3>()) - centre);
  root.head<2>() += dt * now.speed * forward_of(turned.toRotationMatrix());
  root.tail<4>() << turned.w(), turned.vec();
  const DriveOptions& options = controller_.options();
  const double half = 0.5 * now.yaw_rate * options.gauge;
  qpos[left_.qpos] += dt * (now.speed - half) / options.radius;
  qpos[right_.qpos] += dt * (now.speed + half) / options.radius;
}

void TrackDrive::reset() {
  controller_.reset();
  braked_ = true;
}

void TrackDrive::save(StateWriter& writer) const {
  controller_.save(writer);
  writer.put(braked_ ? 1.0 : 0.0);
}

void TrackDrive::restore(StateReader& reader) {
  controller_.restore(reader);
  braked_ = reader.get_count(1) > 0;
}

}  // namespace hurcules
