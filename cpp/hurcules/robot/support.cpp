// A robot that stands on one of its bodies: its free root moves so that this body does not.
//
//   qvel of the root = root_motion v,   root_motion = -(twist of the support by the coordinates,
//   seen at the root)
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

void Robot::stand_on(const std::string& body) {
  const mjModel& m = *model_;
  const Frame frame = this->frame(body);
  require(frame.type == mjOBJ_BODY, "a robot stands on a body; '" + body + "' is none");
  const int root = m.body_rootid[frame.id];
  const int joint = m.body_jntnum[root] > 0 ? m.body_jntadr[root] : -1;
  require(size() > 0 && root == tree_,
          "'" + body + "' belongs to another tree than the coordinates");
  require(joint >= 0 && m.jnt_type[joint] == mjJNT_FREE,
          "a robot stands on a body of a tree with a free joint; '" + body +
              "' is bolted to the world");
  support_ = frame.id;
  root_qpos_ = m.jnt_qposadr[joint];
  root_dof_ = m.jnt_dofadr[joint];
  root_motion_.setZero(6, size());
  note_support();
}

void Robot::note_support() {
  if (support_ < 0) return;
  const Frame support{mjOBJ_BODY, support_};
  p_WS_ = position(support);
  R_WS_ = orientation(support);
}

void Robot::lift_root() {
  if (support_ < 0) return;
  qpos_.segment<7>(root_qpos_) << 0, 0, 0, 1, 0, 0, 0;
}

void Robot::keep_support() {
  if (support_ < 0) return;
  const Frame support{mjOBJ_BODY, support_}, root{mjOBJ_BODY, tree_};
  // X_WR := X_WS (where it stood) X_SR (as the joints are now)
  const Matrix3 turn = R_WS_ * orientation(support).transpose();
  const Vector3 p = p_WS_ + turn * (position(root) - position(support));
  const Eigen::Quaterniond R(Matrix3(turn * orientation(root)));
  qpos_.segment<3>(root_qpos_) = p;
  qpos_.segment<4>(root_qpos_ + 3) << R.w(), R.x(), R.y(), R.z();
  update();
}

void Robot::note_root_speed() {
  if (support_ < 0) return;
  const Frame root{mjOBJ_BODY, tree_};
  const Vector3 arm = position(root) - position({mjOBJ_BODY, support_});
  const Matrix3 R_RW = orientation(root).transpose();
  mj_jacBody(model_.get(), data_.get(), full_.data(), turn_.data(), support_);
  for (Index i = 0; i < size(); ++i) {
    Vector3 v = Vector3::Zero(), w = Vector3::Zero();
    for (const DrivenJoint& joint : coordinates_[static_cast<std::size_t>(i)].joints) {
      v += joint.factor * full_.col(joint.dof);
      w += joint.factor * turn_.col(joint.dof);
    }
    // a free joint's qvel: velocity of the origin in W, angular velocity in its own axes
    root_motion_.col(i) << -(v + w.cross(arm)), -(R_RW * w);
  }
  Eigen::Map<Vector> root_speed(data_->qvel + root_dof_, 6);
  root_speed.setZero();
  for (Index i = 0; i < size(); ++i) root_speed += v_[i] * root_motion_.col(i);
}

bool Robot::stands(int body) const {
  return support_ >= 0 && model_->body_rootid[body] == tree_;
}

Vector3 Robot::support_drift(const Vector3& point, int body) const {
  if (!stands(body)) return Vector3::Zero();
  const double* origin = data_->xpos + 3 * support_;
  mj_jacDot(model_.get(), data_.get(), turn_.data(), nullptr, origin, support_);
  const Vector3 linear = drift(turn_);
  const Vector3 arm = point - Eigen::Map<const Vector3>(origin);
  return linear + support_rotation_drift(body).cross(arm);
}

Vector3 Robot::support_rotation_drift(int body) const {
  if (!stands(body)) return Vector3::Zero();
  const double* origin = data_->xpos + 3 * support_;
  mj_jacDot(model_.get(), data_.get(), nullptr, turn_.data(), origin, support_);
  return drift(turn_);
}

}  // namespace hurcules
