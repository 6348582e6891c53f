// What a robot answers: poses, Jacobians, drifts, centre of mass, inertia, inverse dynamics.
//
//   all joints: qvel = S v, qacc = S a + dS/dt v      S: joints and root by coordinate
//   torque = S' (M qacc + c(qpos, qvel) - passive)    what holds the support drops out: S' sees
//                                                      no force where nothing moves
#include <mujoco/mujoco.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <utility>

#include "hurcules/robot/each_dof.hpp"

namespace hurcules {
namespace {

Vector3 vector(const double* values) {
  return Eigen::Map<const Vector3>(values);
}

int body_of(const mjModel& m, Frame frame) {
  const int i = frame.id;
  switch (frame.type) {
    case mjOBJ_SITE:
      assert(i >= 0 && i < m.nsite);
      return m.site_bodyid[i];
    case mjOBJ_CAMERA:
      assert(i >= 0 && i < m.ncam);
      return m.cam_bodyid[i];
    case mjOBJ_GEOM:
      assert(i >= 0 && i < m.ngeom);
      return m.geom_bodyid[i];
    default:
      assert(frame.type == mjOBJ_BODY && i >= 0 && i < m.nbody);
      return i;
  }
}

// in its body: position (3) [m] and quaternion (4)
std::pair<const double*, const double*> local(const mjModel& m, Frame frame) {
  const int i = frame.id;
  if (frame.type == mjOBJ_SITE) return {m.site_pos + 3 * i, m.site_quat + 4 * i};
  if (frame.type == mjOBJ_CAMERA) return {m.cam_pos + 3 * i, m.cam_quat + 4 * i};
  return {m.geom_pos + 3 * i, m.geom_quat + 4 * i};
}

// I w + m c x v: of an inertia as MuJoCo keeps it (xx, yy, zz, xy, xz, yz, m c, m) and a motion (w, v)
// at the same point
Vector3 angular_momentum(const double* inertia, const double* motion) {
  const double* const i = inertia;
  Matrix3 about;
  about << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return about * vector(motion) + vector(i + 6).cross(vector(motion + 3));
}

}  // namespace

Skeleton::Pose Robot::pose(Frame frame) const {
  const Skeleton::Pose carrier = screws_->pose(body_of(*model_, frame));
  if (frame.type == mjOBJ_BODY) return carrier;
  const auto [p, q] = local(*model_, frame);
  return carrier *
         Skeleton::Pose{vector(p), Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix()};
}

Vector3 Robot::position(Frame frame) const {
  const Skeleton::Pose carrier = screws_->pose(body_of(*model_, frame));
  if (frame.type == mjOBJ_BODY) return carrier.p;
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
  assert(qvel.size() == model_->nv);
  need_com();
  const Vector3 at = position(frame);
  mj_jac(model_.get(), data_.get(), full_.data(), turn_.data(), at.data(), body_of(*model_, frame));
  Twist twist;
  for (int dof = 0; dof < model_->nv; ++dof) {
    twist.linear += qvel[dof] * full_.col(dof);
    twist.angular += qvel[dof] * turn_.col(dof);
  }
  return twist;
}

void Robot::position_jacobian(Frame frame, MatrixRef J) const {
  assert(J.rows() == 3 && J.cols() == size());
  screws_->point_jacobian(position(frame), body_of(*model_, frame), J);
}

void Robot::rotation_jacobian(Frame frame, MatrixRef J) const {
  assert(J.rows() == 3 && J.cols() == size());
  screws_->rotation_jacobian(body_of(*model_, frame), J);
}

void Robot::point_jacobian(const Vector3& point, int body, MatrixRef J) const {
  assert(J.rows() == 3 && J.cols() == size());
  screws_->point_jacobian(point, body, J);
}

bool Robot::moves(Frame frame) const {
  return screws_->moves(body_of(*model_, frame));
}

Vector3 Robot::position_drift(Frame frame) const {
  return screws_->point_drift(position(frame), body_of(*model_, frame));
}

Vector3 Robot::rotation_drift(Frame frame) const {
  return screws_->rotation_drift(body_of(*model_, frame));
}

Vector3 Robot::point_drift(const Vector3& point, int body) const {
  return screws_->point_drift(point, body);
}

Vector3 Robot::com() const {
  need_com();
  return vector(data_->subtree_com + 3 * tree_);
}

void Robot::com_jacobian(MatrixRef J) const {
  need_com();
  mj_jacSubtreeCom(model_.get(), data_.get(), full_.data(), tree_);
  reduce(full_, J);
}

Vector3 Robot::com_drift() const {
  const mjModel& m = *model_;
  Vector3 force = Vector3::Zero();
  need_kinematics();
  if (!screws_->moving() || m.body_subtreemass[tree_] == 0) return force;
  for (int body = tree_; body < m.nbody; ++body) {
    if (m.body_rootid[body] != tree_ || m.body_mass[body] == 0) continue;
    force += m.body_mass[body] * screws_->point_drift(vector(data_->xipos + 3 * body), body);
  }
  return force / m.body_subtreemass[tree_];
}

double Robot::mass() const {
  return model_->body_subtreemass[tree_];
}

double Robot::weight() const {
  return mass() * gravity().norm();
}

Vector3 Robot::gravity() const {
  return vector(model_->opt.gravity);
}

void Robot::angular_momentum_jacobian(MatrixRef A) const {
  need_com();
  mj_crb(model_.get(), data_.get());
  full_.setZero();
  for (int dof = 0; dof < model_->nv; ++dof) {
    const int body = model_->dof_bodyid[dof];
    if (model_->body_rootid[body] != tree_) continue;
    full_.col(dof) = angular_momentum(data_->crb + 10 * body, data_->cdof + 6 * dof);
  }
  reduce(full_, A);
}

Vector3 Robot::angular_momentum_drift() const {
  const mjModel& m = *model_;
  Vector3 moment = Vector3::Zero();
  need_com();
  if (!screws_->moving()) return moment;
  const Vector3 c = com();
  for (int body = tree_; body < m.nbody; ++body) {
    if (m.body_rootid[body] != tree_ || m.body_mass[body] == 0) continue;
    const Vector3 p = vector(data_->xipos + 3 * body), w = screws_->angular_velocity(body);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(data_->ximat + 9 * body);
    const Vector3 inertia = vector(m.body_inertia + 3 * body);
    const auto times = [&](const Vector3& v) -> Vector3 {
      return R * inertia.cwiseProduct(R.transpose() * v);
    };
    moment += m.body_mass[body] * (p - c).cross(screws_->point_drift(p, body)) +
              times(screws_->rotation_drift(body)) + w.cross(times(w));
  }
  return moment;
}

void Robot::mass_matrix(MatrixRef M) const {
  assert(M.rows() == size() && M.cols() == size());
  need_com();
  mj_crb(model_.get(), data_.get());
  mj_fullM(model_.get(), data_.get(), inertia_.data());
  // M = S' inertia S, S the motion of all joints by coordinate
  for (Index k = 0; k < size(); ++k) {
    momentum_.setZero();
    each_dof(k, [&](int dof, double factor) { momentum_ += factor * inertia_.col(dof); });
    if (support_ >= 0)
      for (Index r = 0; r < 6; ++r)
        momentum_ += screws_->root_motion()(r, k) * inertia_.col(root_dof_ + r);
    for (Index i = 0; i < size(); ++i) {
      M(i, k) = 0;
      each_dof(i, [&](int dof, double factor) { M(i, k) += factor * momentum_[dof]; });
      if (support_ >= 0)
        M(i, k) += screws_->root_motion().col(i).dot(momentum_.segment<6>(root_dof_));
    }
  }
}

void Robot::inverse_dynamics(const ConstVectorRef& acceleration, VectorRef torque) const {
  assert(acceleration.size() == size() && torque.size() == size());
  const mjModel& m = *model_;
  mjData* const d = data_.get();
  std::fill_n(d->qacc, m.nv, 0.0);
  Eigen::Map<Vector> qacc(d->qacc, m.nv);
  for (Index i = 0; i < size(); ++i) {
    each_dof(i, [&](int dof, double factor) { qacc[dof] += factor * acceleration[i]; });
    if (support_ >= 0)
      qacc.segment<6>(root_dof_) += acceleration[i] * screws_->root_motion().col(i);
  }
  for (Index f = 0; closures_ && f < closures_->size(); ++f)
    qacc[closures_->dof(f)] += closures_->drift()[f];
  if (support_ >= 0 && screws_->moving()) {
    // what the root accelerates with when the coordinates do not
    const Frame root{mjOBJ_BODY, tree_};
    qacc.segment<3>(root_dof_) += position_drift(root);
    qacc.segment<3>(root_dof_ + 3) += orientation(root).transpose() * rotation_drift(root);
  }
  need_com();
  mj_comVel(&m, d);
  mj_rne(&m, d, 1, efforts_.data());
  mj_passive(&m, d);
  for (int dof = 0; dof < m.nv; ++dof)
    efforts_[dof] += m.dof_armature[dof] * d->qacc[dof] - d->qfrc_passive[dof];
  for (Index i = 0; i < size(); ++i) {
    torque[i] =
        support_ >= 0 ? screws_->root_motion().col(i).dot(efforts_.segment<6>(root_dof_)) : 0.0;
    each_dof(i, [&](int dof, double factor) { torque[i] += factor * efforts_[dof]; });
  }
}

void Robot::floating_inertia(const ConstVectorRef& acceleration, VectorRef torque) const {
  assert(floats() && acceleration.size() == size() && torque.size() == size());
  const mjModel& m = *model_;
  mjData* const d = data_.get();
  need_com();
  mj_crb(&m, d);
  Vector& qacc = momentum_;  // scratch
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

void Robot::reduce(const Matrix& full, MatrixRef J) const {
  assert(J.rows() == 3 && J.cols() == size());
  Eigen::Matrix<double, 3, 6> root = Eigen::Matrix<double, 3, 6>::Zero();
  if (support_ >= 0) root = full.middleCols<6>(root_dof_);
  for (Index i = 0; i < size(); ++i) {
    Vector3 column = Vector3::Zero();
    if (support_ >= 0) column = root * screws_->root_motion().col(i);
    each_dof(i, [&](int dof, double factor) { column += factor * full.col(dof); });
    J.col(i) = column;
  }
}

}  // namespace hurcules
