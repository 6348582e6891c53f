// How bodies move with the coordinates: a screw for each driven joint, and its rate.
//
//   V_b = sum S_j qdot_j       of the driven joints j that move body b
//   A_b = sum V_<j x S_j qdot_j                  at constant coordinate velocities; V_<j: without j
//   a point: v = V.lin + w x r,  a = A.lin + A.rot x r + w x v        r: from the tree's origin
// A root that stands on another body s moves by -V_s and accelerates by -A_s: then s does not.
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "hurcules/robot/robot.hpp"

namespace hurcules {
namespace {

using Screw = Eigen::Matrix<double, 6, 1>;

// rate of a screw b that is fixed in a body with velocity a
Screw cross(const Screw& a, const Screw& b) {
  const Vector3 w = a.head<3>(), v = a.tail<3>(), wb = b.head<3>(), vb = b.tail<3>();
  Screw rate;
  rate << w.cross(wb), w.cross(vb) + v.cross(wb);
  return rate;
}

}  // namespace

void Robot::find_driven() {
  const mjModel& m = *model_;
  for (Index i = 0; i < size(); ++i)
    for (const DrivenJoint& joint : coordinates_[static_cast<std::size_t>(i)].joints)
      driven_.push_back({i, joint.dof, joint.joint, m.jnt_bodyid[joint.joint], joint.factor});
  std::sort(driven_.begin(), driven_.end(),
            [](const Driven& a, const Driven& b) { return a.joint < b.joint; });
  joints_of_.resize(coordinates_.size());
  moves_.assign(static_cast<std::size_t>(m.nbody * driven()), false);
  for (Index j = 0; j < driven(); ++j) {
    const Driven& joint = driven_[static_cast<std::size_t>(j)];
    joints_of_[static_cast<std::size_t>(joint.coordinate)].push_back(j);
    // bodies come after their parents
    for (int body = joint.body; body < m.nbody; ++body) {
      const int parent = m.body_parentid[body];
      const bool below =
          body > joint.body && moves_[static_cast<std::size_t>(parent * driven() + j)];
      moves_[static_cast<std::size_t>(body * driven() + j)] = body == joint.body || below;
    }
  }
  screws_.setZero(6, driven());
  rates_.setZero(6, driven());
  root_screws_.setZero(6, size());
}

Vector3 Robot::origin(int body) const {
  return Eigen::Map<const Vector3>(data_->xpos + 3 * model_->body_rootid[body]);
}

void Robot::note_screws() {
  const mjModel& m = *model_;
  for (Index j = 0; j < driven(); ++j) {
    const Driven& joint = driven_[static_cast<std::size_t>(j)];
    const Vector3 axis = joint.factor * Eigen::Map<const Vector3>(data_->xaxis + 3 * joint.joint);
    const Vector3 arm =
        Eigen::Map<const Vector3>(data_->xanchor + 3 * joint.joint) - origin(joint.body);
    if (m.jnt_type[joint.joint] == mjJNT_SLIDE) {
      screws_.col(j) << Vector3::Zero(), axis;
    } else {
      screws_.col(j) << axis, arm.cross(axis);
    }
  }
  if (support_ < 0) return;
  const Eigen::Map<const Vector3> root(data_->xpos + 3 * tree_);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(data_->xmat + 9 * tree_);
  const Vector3 arm = root - origin(tree_);
  for (Index i = 0; i < size(); ++i) {
    Screw twist = Screw::Zero();
    for (const Index j : joints_of_[static_cast<std::size_t>(i)])
      if (moves(j, support_)) twist -= screws_.col(j);
    root_screws_.col(i) = twist;
    // a free joint's qvel: velocity of the origin in W, angular velocity in its own axes
    const Vector3 w = twist.head<3>();
    root_motion_.col(i) << twist.tail<3>() + w.cross(arm), R.transpose() * w;
  }
}

void Robot::note_root_speed() {
  if (support_ < 0) return;
  Eigen::Map<Screw>(data_->qvel + root_dof_) = root_motion_ * v_;
}

void Robot::note_rates() {
  root_rate_.setZero();
  if (!moving_) return;
  const Screw root = support_ >= 0 ? Screw(root_screws_ * v_) : Screw::Zero();
  for (Index j = 0; j < driven(); ++j) {
    const Driven& joint = driven_[static_cast<std::size_t>(j)];
    Screw before = stands(joint.body) ? root : Screw::Zero();
    for (Index k = 0; k < j; ++k)
      if (moves(k, joint.body))
        before += v_[driven_[static_cast<std::size_t>(k)].coordinate] * screws_.col(k);
    rates_.col(j) = cross(before, screws_.col(j)) * v_[joint.coordinate];
    if (support_ >= 0 && moves(j, support_)) root_rate_ -= rates_.col(j);
  }
}

Robot::Screw Robot::screw(Index coordinate, int body) const {
  Screw twist = stands(body) ? Screw(root_screws_.col(coordinate)) : Screw::Zero();
  for (const Index j : joints_of_[static_cast<std::size_t>(coordinate)])
    if (moves(j, body)) twist += screws_.col(j);
  return twist;
}

Vector3 Robot::point_drift(const Vector3& point, int body) const {
  Screw twist = stands(body) ? Screw(root_screws_ * v_) : Screw::Zero();
  Screw rate = stands(body) ? root_rate_ : Screw::Zero();
  for (Index j = 0; j < driven(); ++j) {
    if (!moves(j, body)) continue;
    twist += v_[driven_[static_cast<std::size_t>(j)].coordinate] * screws_.col(j);
    rate += rates_.col(j);
  }
  const Vector3 r = point - origin(body), w = twist.head<3>();
  const Vector3 v = twist.tail<3>() + w.cross(r);
  return rate.tail<3>() + rate.head<3>().cross(r) + w.cross(v);
}

}  // namespace hurcules
