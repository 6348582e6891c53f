// A robot that stands on one of its bodies: its free root moves so that this body does not.
//
// Where the root goes: X_WR = X_WS (where the support stood) X_SR (as the joints are now), X_SR by
// the joints between them alone. How it moves: screws.cpp.
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {
namespace {

Eigen::Quaterniond quaternion(const double* q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

// the pose of a body in its parent, by its own joints
Eigen::Isometry3d placed(const mjModel& m, int body, const double* qpos) {
  Vector3 p = Eigen::Map<const Vector3>(m.body_pos + 3 * body);
  Eigen::Quaterniond R = quaternion(m.body_quat + 4 * body);
  const int first = m.body_jntadr[body], end = first + m.body_jntnum[body];
  for (int joint = first; joint < end; ++joint) {
    const Eigen::Map<const Vector3> anchor(m.jnt_pos + 3 * joint), axis(m.jnt_axis + 3 * joint);
    const double* const q = qpos + m.jnt_qposadr[joint];
    if (m.jnt_type[joint] == mjJNT_SLIDE) {
      p += R * axis * (q[0] - m.qpos0[m.jnt_qposadr[joint]]);
      continue;
    }
    // about its anchor, which stays
    const Eigen::Quaterniond turn = m.jnt_type[joint] == mjJNT_BALL
                                        ? quaternion(q)
                                        : Eigen::Quaterniond(Eigen::AngleAxisd(
                                              q[0] - m.qpos0[m.jnt_qposadr[joint]], Vector3(axis)));
    const Vector3 stays = p + R * anchor;
    R = R * turn;
    p = stays - R * anchor;
  }
  Eigen::Isometry3d X;
  X.linear() = R.toRotationMatrix();
  X.translation() = p;
  X.makeAffine();
  return X;
}

}  // namespace

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
  update();
  note_support();
}

void Robot::note_support() {
  if (support_ < 0) return;
  const Frame support{mjOBJ_BODY, support_};
  p_WS_ = position(support);
  R_WS_ = orientation(support);
}

void Robot::keep_support() {
  if (support_ < 0) return;
  const mjModel& m = *model_;
  // X_RS, outward from the support to the root
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  for (int body = support_; body != tree_; body = m.body_parentid[body])
    X = placed(m, body, qpos_.data()) * X;
  Eigen::Isometry3d stood;
  stood.linear() = R_WS_;
  stood.translation() = p_WS_;
  stood.makeAffine();
  const Eigen::Isometry3d root = stood * X.inverse();
  const Eigen::Quaterniond R(root.linear());
  qpos_.segment<3>(root_qpos_) = root.translation();
  qpos_.segment<4>(root_qpos_ + 3) << R.w(), R.x(), R.y(), R.z();
}

bool Robot::stands(int body) const {
  return support_ >= 0 && model_->body_rootid[body] == tree_;
}

}  // namespace hurcules
