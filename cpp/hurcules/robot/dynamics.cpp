// Inverse dynamics of the coordinates.
//
//   all joints: qvel = S v, qacc = S a + dS/dt v      S: joints and root by coordinate
//   torque = S' (M qacc + c(qpos, qvel) - passive)    what holds the support drops out: S' sees
//                                                      no force where nothing moves
#include <mujoco/mujoco.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>

#include "hurcules/robot/each_dof.hpp"

namespace hurcules {

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

}  // namespace hurcules
