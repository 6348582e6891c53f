#include "hurcules/robot/screws.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "hurcules/robot/each_screw.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {
namespace {

// rate of a screw b that is fixed in a body with velocity a
Screw cross(const Screw& a, const Screw& b) {
  const Vector3 w = a.head<3>(), v = a.tail<3>(), wb = b.head<3>(), vb = b.tail<3>();
  Screw rate;
  rate << w.cross(wb), w.cross(vb) + v.cross(wb);
  return rate;
}

template <class Driven>
std::vector<int> joints_of(const std::vector<Driven>& driven) {
  std::vector<int> joints;
  for (const Driven& joint : driven) joints.push_back(joint.joint);
  return joints;
}

}  // namespace

Screws::Screws(const mjModel& model, const std::vector<Coordinate>& coordinates,
               const Closures* closures, int root, int support)
    : model_(&model),
      closures_(closures),
      root_(root),
      support_(support),
      driven_(driven_of(model, coordinates, closures)),
      skeleton_(model, joints_of(driven_), support < 0 ? -1 : root),
      velocity_(Vector::Zero(static_cast<Index>(coordinates.size()))) {
  find_above();
  root_motion_.setZero(6, velocity_.size());
}

std::vector<Screws::Driven> Screws::driven_of(const mjModel& model,
                                              const std::vector<Coordinate>& coordinates,
                                              const Closures* closures) {
  std::vector<Driven> driven;
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    for (const DrivenJoint& joint : coordinates[i].joints)
      driven.push_back({.coordinate = static_cast<Index>(i),
                        .follower = -1,
                        .joint = joint.joint,
                        .body = model.jnt_bodyid[joint.joint],
                        .factor = joint.factor,
                        .part = joint.part});
  for (Index f = 0; closures && f < closures->size(); ++f) {
    const int dof = closures->dof(f), joint = model.dof_jntid[dof];
    const int type = model.jnt_type[joint];
    const int first = type == mjJNT_FREE ? 0 : 3;  // a ball joint is the turns alone
    const int part = type == mjJNT_FREE || type == mjJNT_BALL ? dof - model.jnt_dofadr[joint] : -1;
    driven.push_back({.coordinate = -1,
                      .follower = f,
                      .joint = joint,
                      .body = model.dof_bodyid[dof],
                      .factor = 1.0,
                      .part = part < 0 ? -1 : first + part});
  }
  std::sort(driven.begin(), driven.end(), [](const Driven& a, const Driven& b) {
    return std::pair(a.joint, a.part) < std::pair(b.joint, b.part);
  });
  return driven;
}

void Screws::find_above() {
  const mjModel& m = *model_;
  above_.assign(static_cast<std::size_t>(m.nbody), {});
  // bodies come after their parents
  for (int body = 1; body < m.nbody; ++body) {
    std::vector<Index>& joints = above_[static_cast<std::size_t>(body)];
    joints = above(m.body_parentid[body]);
    for (std::size_t j = 0; j < driven_.size(); ++j) {
      if (driven_[j].body != body) continue;
      driven_[j].before = joints.empty() ? -1 : joints.back();
      joints.push_back(static_cast<Index>(j));
    }
  }
}

Vector3 Screws::origin(int body) const {
  return skeleton_.position(model_->body_rootid[body]);
}

bool Screws::stands(int body) const {
  return support_ >= 0 && model_->body_rootid[body] == root_;
}

void Screws::place(const double* qpos) {
  skeleton_.place(*model_, qpos);
  for (std::size_t j = 0; j < driven_.size(); ++j) {
    Driven& joint = driven_[j];
    const Vector3& axis = skeleton_.axis(static_cast<Index>(j));
    const Vector3& anchor = skeleton_.anchor(static_cast<Index>(j));
    if (joint.part >= 0) {
      joint.screw.setZero();
      if (joint.part < 3) {
        joint.screw[3 + joint.part] = 1.0;
      } else {
        const Vector3 own = pose(joint.body).R.col(joint.part - 3);
        joint.screw.head<3>() = own;
        if (model_->jnt_type[joint.joint] == mjJNT_BALL) {
          // the last of its parts keeps the anchor
          const Vector3& centre = skeleton_.anchor(static_cast<Index>(j) + 5 - joint.part);
          joint.screw.tail<3>() = (centre - origin(joint.body)).cross(own);
        }
      }
    } else if (model_->jnt_type[joint.joint] == mjJNT_SLIDE) {
      joint.screw << Vector3::Zero(), joint.factor * axis;
    } else {
      joint.screw << joint.factor * axis, joint.factor * (anchor - origin(joint.body)).cross(axis);
    }
  }
  if (support_ >= 0) note_root();
}

void Screws::note_root() {
  root_motion_.setZero();
  for (const Index j : above(support_))
    each_coordinate(driven(j),
                    [&](Index i, double share) { root_motion_.col(i) -= share * driven(j).screw; });
  // a free joint's qvel: velocity of the origin in W, angular velocity in its own axes
  const Matrix3 R = pose(root_).R;
  for (Index i = 0; i < root_motion_.cols(); ++i) {
    const Vector3 w = root_motion_.col(i).head<3>(), v = root_motion_.col(i).tail<3>();
    root_motion_.col(i) << v, R.transpose() * w;
  }
}

void Screws::set_velocity(const Vector& velocity) {
  velocity_ = velocity;
  moving_ = (velocity.array() != 0).any();
  root_velocity_.setZero();
  root_rate_.setZero();
  if (!moving_) return;
  for (Driven& joint : driven_) {
    joint.speed = 0.0;
    each_coordinate(joint, [&](Index i, double share) { joint.speed += share * velocity_[i]; });
  }
  if (support_ >= 0)
    for (const Index j : above(support_)) root_velocity_ -= driven(j).speed * driven(j).screw;
  for (Driven& joint : driven_) {  // those before it come before it
    const auto velocity_to = [&](Index j) {
      return j < 0 ? root_velocity_of(joint.body) : driven(j).velocity_to;
    };
    Index j = joint.before;
    joint.velocity_to = velocity_to(j) + joint.speed * joint.screw;
    // what turns at once does not turn the other
    while (joint.part >= 3 && j >= 0 && driven(j).joint == joint.joint && driven(j).part >= 3)
      j = driven(j).before;
    joint.rate = cross(velocity_to(j), joint.screw) * joint.speed;
    if (joint.follower >= 0) joint.rate += closures_->drift()[joint.follower] * joint.screw;
  }
  if (support_ >= 0)
    for (const Index j : above(support_)) root_rate_ -= driven(j).rate;
  for (Driven& joint : driven_)
    joint.rate_to =
        (joint.before < 0 ? root_rate_of(joint.body) : driven(joint.before).rate_to) + joint.rate;
}

template <class Of>
void Screws::fill(int body, MatrixRef J, Of&& of) const {
  J.setZero();
  for (const Index j : above(body))
    each_coordinate(driven(j),
                    [&](Index i, double share) { J.col(i) += share * of(driven(j).screw); });
  if (!stands(body)) return;
  for (const Index j : above(support_))
    each_coordinate(driven(j),
                    [&](Index i, double share) { J.col(i) -= share * of(driven(j).screw); });
}

void Screws::point_jacobian(const Vector3& point, int body, MatrixRef J) const {
  const Vector3 r = point - origin(body);
  fill(body, J, [&](const Screw& screw) -> Vector3 {
    return screw.tail<3>() + Vector3(screw.head<3>()).cross(r);
  });
}

void Screws::rotation_jacobian(int body, MatrixRef J) const {
  fill(body, J, [](const Screw& screw) -> Vector3 { return screw.head<3>(); });
}

void Screws::separation(const BodyPoint& first, const BodyPoint& second, const Vector3& direction,
                        Eigen::Ref<Eigen::RowVectorXd> row) const {
  row.setZero();
  // what moves both comes first in both lists
  const std::span<const Index> a = above(first.body), b = above(second.body);
  const auto apart = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  add_rates({apart.first, a.end()}, first, -direction, row);
  add_rates({apart.second, b.end()}, second, direction, row);
  // it turns the way between them, which matters where that is not along the direction
  const Vector3 moment = (second.point - first.point).cross(direction);
  const auto turn = [&](Index j, double sign) {
    const double rate = sign * moment.dot(driven(j).screw.head<3>());
    each_coordinate(driven(j), [&](Index i, double share) { row[i] += share * rate; });
  };
  for (auto j = a.begin(); j != apart.first; ++j) turn(*j, 1.0);
  const bool first_stands = stands(first.body), second_stands = stands(second.body);
  if (first_stands && second_stands) {
    for (const Index j : above(support_)) turn(j, -1.0);
  } else if (first_stands) {
    add_rates(above(support_), first, direction, row);
  } else if (second_stands) {
    add_rates(above(support_), second, -direction, row);
  }
}

void Screws::add_rates(std::span<const Index> joints, const BodyPoint& at, const Vector3& direction,
                       Eigen::Ref<Eigen::RowVectorXd> row) const {
  const Vector3 moment = (at.point - origin(at.body)).cross(direction);
  for (const Index j : joints) {
    const Screw& screw = driven(j).screw;
    const double rate = moment.dot(screw.head<3>()) + direction.dot(screw.tail<3>());
    each_coordinate(driven(j), [&](Index i, double share) { row[i] += share * rate; });
  }
}

Screw Screws::root_velocity_of(int body) const {
  return stands(body) ? root_velocity_ : Screw::Zero();
}

Screw Screws::root_rate_of(int body) const {
  return stands(body) ? root_rate_ : Screw::Zero();
}

Screw Screws::velocity_of(int body) const {
  return above(body).empty() ? root_velocity_of(body) : driven(above(body).back()).velocity_to;
}

Screw Screws::rate_of(int body) const {
  return above(body).empty() ? root_rate_of(body) : driven(above(body).back()).rate_to;
}

Vector3 Screws::point_drift(const Vector3& point, int body) const {
  if (!moving_) return Vector3::Zero();
  const Screw twist = velocity_of(body), rate = rate_of(body);
  const Vector3 r = point - origin(body), w = twist.head<3>();
  const Vector3 v = twist.tail<3>() + w.cross(r);
  return rate.tail<3>() + Vector3(rate.head<3>()).cross(r) + w.cross(v);
}

Vector3 Screws::rotation_drift(int body) const {
  return moving_ ? Vector3(rate_of(body).head<3>()) : Vector3::Zero();
}

}  // namespace hurcules
