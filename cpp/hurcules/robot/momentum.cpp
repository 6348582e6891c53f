#include "hurcules/robot/momentum.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>

#include "hurcules/base/pose.hpp"
#include "hurcules/robot/each_screw.hpp"

namespace hurcules {
namespace {

using Pose = Skeleton::Pose;

// of a kilogram at r
Matrix3 second_moment(const Vector3& r) {
  return r.squaredNorm() * Matrix3::Identity() - r * r.transpose();
}

// how its own frame stands in a body
Pose of_inertia(const mjModel& m, int body) {
  const double* const q = m.body_iquat + 4 * body;
  return {vector_of(m.body_ipos + 3 * body),
          Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix()};
}

}  // namespace

Momentum::Momentum(const mjModel& model, int root, const Skeleton& skeleton)
    : model_(&model),
      root_(root),
      noted_(static_cast<std::size_t>(skeleton.bones() + 1)),
      own_(noted_),
      below_(noted_) {}

bool Momentum::contains(int body) const {
  return root_ == 0 || model_->body_rootid[body] == root_;
}

void Momentum::note(const Skeleton& skeleton) {
  const mjModel& m = *model_;
  for (Inertia& part : noted_) part = {};
  for (int body = 1; body < m.nbody; ++body) {
    const double mass = m.body_mass[body];
    if (!contains(body) || mass == 0.0) continue;
    const Pose pose = skeleton.hanging(body) * of_inertia(m, body);
    Inertia& part = noted_[static_cast<std::size_t>(skeleton.bone_of(body) + 1)];
    part.mass += mass;
    part.moment += mass * pose.p;
    part.second += pose.R * vector_of(m.body_inertia + 3 * body).asDiagonal() * pose.R.transpose() +
                   mass * second_moment(pose.p);
  }
  for (Inertia& part : noted_)
    if (part.mass > 0.0) part.second -= part.mass * second_moment(part.moment / part.mass);
}

void Momentum::place(const Screws& screws) {
  const Skeleton& skeleton = screws.skeleton();
  const Vector3 origin = screws.origin(root_);
  for (int bone = -1; bone < skeleton.bones(); ++bone) {
    const Inertia& part = noted_[static_cast<std::size_t>(bone + 1)];
    Inertia& placed = own(bone);
    if (part.mass == 0.0) {
      placed = {};
      continue;
    }
    const Pose pose = skeleton.of_bone(bone);
    const Vector3 r = pose.p + pose.R * (part.moment / part.mass) - origin;
    placed.mass = part.mass;
    placed.moment = part.mass * r;
    placed.second = pose.R * part.second * pose.R.transpose() + part.mass * second_moment(r);
  }
  below_ = own_;
  for (int bone = skeleton.bones() - 1; bone >= 0; --bone) {
    Inertia& sum = below(skeleton.parent_of(bone));
    sum.mass += below(bone).mass;
    sum.moment += below(bone).moment;
    sum.second += below(bone).second;
  }
  const Inertia& all = below(-1);
  if (all.mass > 0.0) {
    arm_ = all.moment / all.mass;
  } else {  // as MuJoCo: that of the root
    const Pose pose = skeleton.pose(root_);
    arm_ = pose.p + pose.R * vector_of(model_->body_ipos + 3 * root_) - origin;
  }
  com_ = origin + arm_;
}

void Momentum::com_jacobian(const Screws& screws, MatrixRef J) const {
  J.setZero();
  const double mass = below(-1).mass;
  if (mass == 0.0) return;
  const Skeleton& skeleton = screws.skeleton();
  screws.each_screw([&](Index i, int body, const Screw& screw) {
    const Inertia& moved = below(skeleton.bone_of(body));
    const Vector3 w = screw.head<3>(), v = screw.tail<3>();
    J.col(i) += (moved.mass * v + w.cross(moved.moment)) / mass;
  });
}

void Momentum::angular_jacobian(const Screws& screws, MatrixRef A) const {
  A.setZero();
  const Skeleton& skeleton = screws.skeleton();
  screws.each_screw([&](Index i, int body, const Screw& screw) {
    const Inertia& moved = below(skeleton.bone_of(body));
    const Vector3 w = screw.head<3>(), v = screw.tail<3>();
    const Vector3 p = moved.mass * v + w.cross(moved.moment);
    A.col(i) += moved.second * w + moved.moment.cross(v) - arm_.cross(p);
  });
}

const Momentum::Rate& Momentum::rate(const Screws& screws) const {
  if (rate_) return *rate_;
  Rate& sum = rate_.emplace();
  if (!screws.moving()) return sum;
  const Skeleton& skeleton = screws.skeleton();
  for (int bone = 0; bone < skeleton.bones(); ++bone) {
    const Inertia& part = own(bone);
    if (part.mass == 0.0) continue;
    const Screw velocity = screws.velocity_of(skeleton.body_of(bone)),
                change = screws.rate_of(skeleton.body_of(bone));
    const Vector3 w = velocity.head<3>(), v = velocity.tail<3>();
    const Vector3 turn = change.head<3>(), way = change.tail<3>();
    const Vector3 p = part.mass * v + w.cross(part.moment);
    const Vector3 L = part.second * w + part.moment.cross(v);
    sum.force += part.mass * way + turn.cross(part.moment) + w.cross(p);
    sum.torque += part.second * turn + part.moment.cross(way) + w.cross(L) + v.cross(p);
  }
  return sum;
}

Vector3 Momentum::com_drift(const Screws& screws) const {
  const double mass = below(-1).mass;
  return mass > 0.0 ? Vector3(rate(screws).force / mass) : Vector3::Zero();
}

Vector3 Momentum::angular_drift(const Screws& screws) const {
  const Rate& change = rate(screws);
  return change.torque - arm_.cross(change.force);
}

}  // namespace hurcules
