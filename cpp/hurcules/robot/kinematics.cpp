// What a robot answers: poses, Jacobians, drifts, centre of mass, inertia, inverse dynamics.
//
//   all joints: qvel = S v, qacc = S a + dS/dt v      S: joints and root by coordinate
//   torque = S' (M qacc + c(qpos, qvel) - passive)    what holds the support drops out: S' sees
//                                                      no force where nothing moves
#include <mujoco/mujoco.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/robot/each_dof.hpp"
#include "hurcules/robot/momentum.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {
namespace {

Vector3 vector(const double* values) {
  return Eigen::Map<const Vector3>(values);
}

// in its body: position (3) [m] and quaternion (4)
std::pair<const double*, const double*> local(const mjModel& m, Frame frame) {
  const int i = frame.id;
  if (frame.type == mjOBJ_SITE) return {m.site_pos + 3 * i, m.site_quat + 4 * i};
  if (frame.type == mjOBJ_CAMERA) return {m.cam_pos + 3 * i, m.cam_quat + 4 * i};
  return {m.geom_pos + 3 * i, m.geom_quat + 4 * i};
}

// adds what the joints of a body, which stands at this pose, give a point by these velocities
void add_joints(const mjModel& m, int body, Skeleton::Pose pose, const double* qpos,
                const double* qvel, const Vector3& at, Twist& twist) {
  const int first = m.body_jntadr[body];
  // the last one first: those before do not move with it
  for (int joint = first + m.body_jntnum[body] - 1; joint >= first; --joint) {
    const double* const v = qvel + m.jnt_dofadr[joint];
    const Vector3 axis = pose.R * vector(m.jnt_axis + 3 * joint);
    Vector3 anchor = pose.p + pose.R * vector(m.jnt_pos + 3 * joint), spin = Vector3::Zero();
    switch (m.jnt_type[joint]) {
      case mjJNT_FREE:
        anchor = pose.p;
        twist.linear += vector(v);
        spin = pose.R * vector(v + 3);
        break;
      case mjJNT_BALL:
        spin = pose.R * vector(v);
        break;
      case mjJNT_SLIDE:
        twist.linear += v[0] * axis;
        break;
      default:
        spin = v[0] * axis;
    }
    twist.angular += spin;
    twist.linear += spin.cross(at - anchor);
    if (joint > first) pose = Skeleton::before(m, joint, pose, qpos);
  }
}

void require_body(const mjModel& m, int body) {
  if (body >= 0 && body < m.nbody) return;
  throw Error("a point wants a body from 0 to " + std::to_string(m.nbody - 1) + ", got " +
              std::to_string(body));
}

}  // namespace

Skeleton::Pose Robot::pose(Frame frame) const {
  const Skeleton::Pose carrier = screws().pose(body_of(*model_, frame));
  if (frame.type == mjOBJ_BODY) return carrier;
  const auto [p, q] = local(*model_, frame);
  return carrier *
         Skeleton::Pose{vector(p), Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix()};
}

Vector3 Robot::position(Frame frame) const {
  const int body = body_of(*model_, frame);
  if (frame.type == mjOBJ_BODY) return screws().skeleton().position(body);
  const Skeleton::Pose carrier = screws().pose(body);
  return carrier.p + carrier.R * vector(local(*model_, frame).first);
}

Matrix3 Robot::orientation(Frame frame) const {
  return pose(frame).R;
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
  require_size("twist: qvel", qvel.size(), model_->nv);
  const mjModel& m = *model_;
  const Vector3 at = position(frame);
  Twist twist;
  for (int body = body_of(m, frame); body > 0; body = m.body_parentid[body])
    add_joints(m, body, screws().pose(body), qpos_.data(), qvel.data(), at, twist);
  return twist;
}

void Robot::position_jacobian(Frame frame, MatrixRef J) const {
  require_shape("position_jacobian", J, 3, size());
  screws().point_jacobian(position(frame), body_of(*model_, frame), J);
}

void Robot::rotation_jacobian(Frame frame, MatrixRef J) const {
  require_shape("rotation_jacobian", J, 3, size());
  screws().rotation_jacobian(body_of(*model_, frame), J);
}

void Robot::point_jacobian(const Vector3& point, int body, MatrixRef J) const {
  require_body(*model_, body);
  require_shape("point_jacobian", J, 3, size());
  screws().point_jacobian(point, body, J);
}

bool Robot::moves(Frame frame) const {
  return screws().moves(body_of(*model_, frame));
}

bool Robot::moves(Frame first, Frame second) const {
  return screws().moves(body_of(*model_, first), body_of(*model_, second));
}

Vector3 Robot::position_drift(Frame frame) const {
  return screws().point_drift(position(frame), body_of(*model_, frame));
}

Vector3 Robot::rotation_drift(Frame frame) const {
  return screws().rotation_drift(body_of(*model_, frame));
}

Vector3 Robot::point_drift(const Vector3& point, int body) const {
  require_body(*model_, body);
  return screws().point_drift(point, body);
}

void Robot::separation(const BodyPoint& first, const BodyPoint& second, const Vector3& direction,
                       Eigen::Ref<Eigen::RowVectorXd> row) const {
  require_size("separation", row.size(), size());
  screws().separation(first, second, direction, row);
}

Vector3 Robot::com() const {
  return momentum().com();
}

void Robot::com_jacobian(MatrixRef J) const {
  require_shape("com_jacobian", J, 3, size());
  momentum().com_jacobian(screws(), J);
}

Vector3 Robot::com_drift() const {
  return momentum().com_drift(screws());
}

double Robot::mass() const {
  return model_->body_subtreemass[root_body()];
}

double Robot::weight() const {
  return mass() * gravity().norm();
}

Vector3 Robot::gravity() const {
  return vector(model_->opt.gravity);
}

void Robot::angular_momentum_jacobian(MatrixRef A) const {
  require_shape("angular_momentum_jacobian", A, 3, size());
  momentum().angular_jacobian(screws(), A);
}

Vector3 Robot::angular_momentum_drift() const {
  return momentum().angular_drift(screws());
}

void Robot::mass_matrix(MatrixRef M) const {
  require_shape("mass_matrix", M, size(), size());
  need_mujoco();
  mj_crb(model_.get(), data_.get());
  mj_fullM(model_.get(), data_.get(), inertia_.data());
  // M = S' inertia S, S the motion of all joints by coordinate
  for (Index k = 0; k < size(); ++k) {
    column_.setZero();
    each_dof(k, [&](int dof, double factor) { column_ += factor * inertia_.col(dof); });
    if (support_ >= 0)
      for (Index r = 0; r < 6; ++r)
        column_ += screws().root_motion()(r, k) * inertia_.col(root_dof_ + r);
    for (Index i = 0; i < size(); ++i) {
      M(i, k) = 0;
      each_dof(i, [&](int dof, double factor) { M(i, k) += factor * column_[dof]; });
      if (support_ >= 0)
        M(i, k) += screws().root_motion().col(i).dot(column_.segment<6>(root_dof_));
    }
  }
}

void Robot::inverse_dynamics(const ConstVectorRef& acceleration, VectorRef torque) const {
  require_size("inverse_dynamics: acceleration", acceleration.size(), size());
  require_size("inverse_dynamics: torque", torque.size(), size());
  const mjModel& m = *model_;
  mjData* const d = data_.get();
  std::fill_n(d->qacc, m.nv, 0.0);
  Eigen::Map<Vector> qacc(d->qacc, m.nv);
  for (Index i = 0; i < size(); ++i) {
    each_dof(i, [&](int dof, double factor) { qacc[dof] += factor * acceleration[i]; });
    if (support_ >= 0)
      qacc.segment<6>(root_dof_) += acceleration[i] * screws().root_motion().col(i);
  }
  for (Index f = 0; closures_ && f < closures_->size(); ++f)
    qacc[closures_->dof(f)] += closures_->drift()[f];
  if (support_ >= 0 && screws().moving()) {
    // what the root accelerates with when the coordinates do not
    const Frame root{mjOBJ_BODY, root_body()};
    qacc.segment<3>(root_dof_) += position_drift(root);
    qacc.segment<3>(root_dof_ + 3) += orientation(root).transpose() * rotation_drift(root);
  }
  need_mujoco();
  mj_comVel(&m, d);
  mj_rne(&m, d, 1, efforts_.data());
  mj_passive(&m, d);
  for (int dof = 0; dof < m.nv; ++dof) {
    efforts_[dof] += m.dof_armature[dof] * d->qacc[dof] - d->qfrc_passive[dof];
    // what MuJoCo adds to the actuators' forces is no passive force
    if (m.jnt_actgravcomp[m.dof_jntid[dof]]) efforts_[dof] -= d->qfrc_gravcomp[dof];
  }
  for (Index i = 0; i < size(); ++i) {
    torque[i] =
        support_ >= 0 ? screws().root_motion().col(i).dot(efforts_.segment<6>(root_dof_)) : 0.0;
    each_dof(i, [&](int dof, double factor) { torque[i] += factor * efforts_[dof]; });
  }
}

void Robot::floating_inertia(const ConstVectorRef& acceleration, VectorRef torque) const {
  require(floats(), "floating_inertia wants a robot whose root is free and stands on nothing");
  require_size("floating_inertia: acceleration", acceleration.size(), size());
  require_size("floating_inertia: torque", torque.size(), size());
  const mjModel& m = *model_;
  mjData* const d = data_.get();
  need_mujoco();
  mj_crb(&m, d);
  Vector& qacc = column_;  // scratch
  qacc.setZero();
  Eigen::Matrix<double, 6, 6> root;
  for (Index r = 0; r < 6; ++r) {
    qacc[root_dof_ + r] = 1.0;
    mj_mulM(&m, d, efforts_.data(), qacc.data());
    root.col(r) = efforts_.segment<6>(root_dof_);
    qacc[root_dof_ + r] = 0.0;
  }
  for (Index i = 0; i < size(); ++i)
    each_dof(i, [&](int dof, double factor) { qacc[dof] += factor * acceleration[i]; });
  mj_mulM(&m, d, efforts_.data(), qacc.data());
  qacc.segment<6>(root_dof_) = -root.ldlt().solve(efforts_.segment<6>(root_dof_));
  mj_mulM(&m, d, efforts_.data(), qacc.data());
  for (Index i = 0; i < size(); ++i) {
    torque[i] = 0.0;
    each_dof(i, [&](int dof, double factor) { torque[i] += factor * efforts_[dof]; });
  }
}

}  // namespace hurcules
