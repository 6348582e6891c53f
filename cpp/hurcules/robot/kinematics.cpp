// What a robot answers: poses, Jacobians, drifts, centre of mass, inertia.
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <cassert>

#include "hurcules/robot/robot.hpp"

namespace hurcules {
namespace {

// Pose of a frame in W and the body that carries it.
struct Placement {
  const double* position;     // [m], (3)
  const double* orientation;  // (3, 3) by rows
  int body;
};

Placement placement(const mjModel& m, const mjData& d, Frame frame) {
  const int i = frame.id;
  assert(i >= 0);
  switch (frame.type) {
    case mjOBJ_SITE:
      assert(i < m.nsite);
      return {d.site_xpos + 3 * i, d.site_xmat + 9 * i, m.site_bodyid[i]};
    case mjOBJ_CAMERA:
      assert(i < m.ncam);
      return {d.cam_xpos + 3 * i, d.cam_xmat + 9 * i, m.cam_bodyid[i]};
    case mjOBJ_GEOM:
      assert(i < m.ngeom);
      return {d.geom_xpos + 3 * i, d.geom_xmat + 9 * i, m.geom_bodyid[i]};
    default:
      assert(frame.type == mjOBJ_BODY && i < m.nbody);
      return {d.xpos + 3 * i, d.xmat + 9 * i, i};
  }
}

Vector3 vector(const double* values) {
  return Eigen::Map<const Vector3>(values);
}

Matrix3 matrix(const double* rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
}

}  // namespace

Vector3 Robot::position(Frame frame) const {
  return vector(placement(*model_, *data_, frame).position);
}

Matrix3 Robot::orientation(Frame frame) const {
  return matrix(placement(*model_, *data_, frame).orientation);
}

Matrix3 Robot::view_orientation(Frame frame) const {
  const Matrix3 R = orientation(frame);
  if (frame.type != mjOBJ_CAMERA) return R;
  // MuJoCo's camera: x right, y up, looks along -z
  Matrix3 view;
  view << -R.col(2), -R.col(0), R.col(1);
  return view;
}

Twist Robot::twist(Frame frame, const ConstVectorRef& qvel) const {
  assert(qvel.size() == model_->nv);
  const Placement at = placement(*model_, *data_, frame);
  mj_jac(model_.get(), data_.get(), full_.data(), turn_.data(), at.position, at.body);
  Twist twist;
  for (int dof = 0; dof < model_->nv; ++dof) {
    twist.linear += qvel[dof] * full_.col(dof);
    twist.angular += qvel[dof] * turn_.col(dof);
  }
  return twist;
}

void Robot::position_jacobian(Frame frame, MatrixRef J) const {
  const Placement at = placement(*model_, *data_, frame);
  mj_jac(model_.get(), data_.get(), full_.data(), nullptr, at.position, at.body);
  reduce(full_, J);
}

void Robot::rotation_jacobian(Frame frame, MatrixRef J) const {
  const Placement at = placement(*model_, *data_, frame);
  mj_jac(model_.get(), data_.get(), nullptr, full_.data(), at.position, at.body);
  reduce(full_, J);
}

Vector3 Robot::position_drift(Frame frame) const {
  if (!moving_) return Vector3::Zero();
  const Placement at = placement(*model_, *data_, frame);
  mj_jacDot(model_.get(), data_.get(), full_.data(), nullptr, at.position, at.body);
  return drift(full_) - support_drift(vector(at.position), at.body);
}

Vector3 Robot::rotation_drift(Frame frame) const {
  if (!moving_) return Vector3::Zero();
  const Placement at = placement(*model_, *data_, frame);
  mj_jacDot(model_.get(), data_.get(), nullptr, full_.data(), at.position, at.body);
  return drift(full_) - support_rotation_drift(at.body);
}

Vector3 Robot::com() const {
  return vector(data_->subtree_com + 3 * tree_);
}

void Robot::com_jacobian(MatrixRef J) const {
  mj_jacSubtreeCom(model_.get(), data_.get(), full_.data(), tree_);
  reduce(full_, J);
}

Vector3 Robot::com_drift() const {
  const mjModel& m = *model_;
  Vector3 force = Vector3::Zero();
  if (!moving_ || m.body_subtreemass[tree_] == 0) return force;
  for (int body = tree_; body < m.nbody; ++body) {
    if (m.body_rootid[body] != tree_ || m.body_mass[body] == 0) continue;
    mj_jacDot(&m, data_.get(), full_.data(), nullptr, data_->xipos + 3 * body, body);
    force += m.body_mass[body] * drift(full_);
  }
  return force / m.body_subtreemass[tree_] - support_drift(com(), tree_);
}

void Robot::mass_matrix(MatrixRef M) const {
  assert(M.rows() == size() && M.cols() == size());
  mj_crb(model_.get(), data_.get());
  mj_fullM(model_.get(), data_.get(), inertia_.data());
  // M = S' inertia S, S the motion of all joints by coordinate
  for (Index k = 0; k < size(); ++k) {
    momentum_.setZero();
    for (const DrivenJoint& joint : coordinates_[k].joints)
      momentum_ += joint.factor * inertia_.col(joint.dof);
    if (support_ >= 0)
      for (Index r = 0; r < 6; ++r) momentum_ += root_motion_(r, k) * inertia_.col(root_dof_ + r);
    for (Index i = 0; i < size(); ++i) {
      M(i, k) = 0;
      for (const DrivenJoint& joint : coordinates_[i].joints)
        M(i, k) += joint.factor * momentum_[joint.dof];
      if (support_ >= 0) M(i, k) += root_motion_.col(i).dot(momentum_.segment<6>(root_dof_));
    }
  }
}

void Robot::reduce(const Matrix& full, MatrixRef J) const {
  assert(J.rows() == 3 && J.cols() == size());
  for (Index i = 0; i < size(); ++i) {
    J.col(i).setZero();
    for (const DrivenJoint& joint : coordinates_[i].joints)
      J.col(i) += joint.factor * full.col(joint.dof);
    if (support_ < 0) continue;
    for (Index r = 0; r < 6; ++r) J.col(i) += root_motion_(r, i) * full.col(root_dof_ + r);
  }
}

Vector3 Robot::drift(const Matrix& jacobian_rate) const {
  Vector3 acceleration = Vector3::Zero();
  for (int dof = 0; dof < model_->nv; ++dof)
    acceleration += data_->qvel[dof] * jacobian_rate.col(dof);
  return acceleration;
}

}  // namespace hurcules
