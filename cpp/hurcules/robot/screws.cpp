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
  driven_.clear();
  for (Index i = 0; i < size(); ++i)
    for (const DrivenJoint& joint : coordinates_[static_cast<std::size_t>(i)].joints)
      driven_.push_back({i, joint.dof, joint.joint, m.jnt_bodyid[joint.joint], joint.factor});
  std::sort(driven_.begin(), driven_.end(),
            [](const Driven& a, const Driven& b) { return a.joint < b.joint; });
  above_.assign(static_cast<std::size_t>(m.nbody), {});
  // bodies come after their parents
  for (int body = 1; body < m.nbody; ++body) {
    std::vector<Index>& joints = above_[static_cast<std::size_t>(body)];
    joints = above(m.body_parentid[body]);
    for (Index j = 0; j < driven(); ++j)
      if (driven_[static_cast<std::size_t>(j)].body == body) joints.push_back(j);
  }
  screws_.setZero(6, driven());
  rates_.setZero(6, driven());
  root_screws_.setZero(6, size());
  std::vector<int> joints;
  for (const Driven& joint : driven_) joints.push_back(joint.joint);
  skeleton_ = std::make_unique<Skeleton>(m, joints, support_ < 0 ? -1 : tree_);
}

Vector3 Robot::origin(int body) const {
  return pose(model_->body_rootid[body]).p;
}

void Robot::note_screws() {
  const mjModel& m = *model_;
  for (Index j = 0; j < driven(); ++j) {
    const Driven& joint = driven_[static_cast<std::size_t>(j)];
    const Vector3& axis = skeleton_->axis(j);
    if (m.jnt_type[joint.joint] == mjJNT_SLIDE) {
      screws_.col(j) << Vector3::Zero(), joint.factor * axis;
    } else {
      screws_.col(j) << joint.factor * axis,
          joint.factor * (skeleton_->anchor(j) - origin(joint.body)).cross(axis);
    }
  }
  if (support_ < 0) return;
  root_screws_.setZero();
  for (const Index j : above(support_))
    root_screws_.col(driven_[static_cast<std::size_t>(j)].coordinate) -= screws_.col(j);
  // a free joint's qvel: velocity of the origin in W, angular velocity in its own axes
  root_motion_.topRows<3>() = root_screws_.bottomRows<3>();
  root_motion_.bottomRows<3>().noalias() = pose(tree_).R.transpose() * root_screws_.topRows<3>();
}

void Robot::note_rates() {
  if (support_ >= 0) Eigen::Map<Screw>(data_->qvel + root_dof_).noalias() = root_motion_ * v_;
  root_rate_.setZero();
  if (!moving_) return;
  const Screw root = support_ >= 0 ? Screw(root_screws_ * v_) : Screw::Zero();
  for (Index j = 0; j < driven(); ++j) {
    const Driven& joint = driven_[static_cast<std::size_t>(j)];
    Screw before = stands(joint.body) ? root : Screw::Zero();
    for (const Index k : above(joint.body))
      if (k < j) before += v_[driven_[static_cast<std::size_t>(k)].coordinate] * screws_.col(k);
    rates_.col(j) = cross(before, screws_.col(j)) * v_[joint.coordinate];
  }
  if (support_ < 0) return;
  for (const Index j : above(support_)) root_rate_ -= rates_.col(j);
}

Robot::Screw Robot::velocity_of(int body) const {
  Screw twist = stands(body) ? Screw(root_screws_ * v_) : Screw::Zero();
  for (const Index j : above(body))
    twist += v_[driven_[static_cast<std::size_t>(j)].coordinate] * screws_.col(j);
  return twist;
}

Robot::Screw Robot::rate_of(int body) const {
  Screw rate = stands(body) ? root_rate_ : Screw::Zero();
  for (const Index j : above(body)) rate += rates_.col(j);
  return rate;
}

Vector3 Robot::point_drift(const Vector3& point, int body) const {
  const Screw twist = velocity_of(body), rate = rate_of(body);
  const Vector3 r = point - origin(body), w = twist.head<3>();
  const Vector3 v = twist.tail<3>() + w.cross(r);
  return rate.tail<3>() + Vector3(rate.head<3>()).cross(r) + w.cross(v);
}

}  // namespace hurcules
