#include "hurcules/robot/loose_joints.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace hurcules {

LooseJoints::LooseJoints(const Robot& robot, std::vector<int> dofs)
    : dofs_(std::move(dofs)), data_(nullptr, mj_deleteData) {
  if (dofs_.empty()) return;
  data_.reset(mj_makeData(robot.model().get()));
  const Index n = robot.size();
  motion_ = Matrix::Zero(robot.model()->nv, n + static_cast<Index>(dofs_.size()));
  for (Index k = 0; k < n; ++k)
    for (const DrivenJoint& joint : robot.coordinates()[static_cast<std::size_t>(k)].joints)
      motion_(joint.dof, k) = joint.factor;
  for (std::size_t i = 0; i < dofs_.size(); ++i) motion_(dofs_[i], n + static_cast<Index>(i)) = 1.0;
}

double LooseJoints::gain(const Robot& robot) {
  if (dofs_.empty()) return 1.0;
  const mjModel* const m = robot.model().get();
  std::copy(robot.qpos().begin(), robot.qpos().end(), data_->qpos);
  mj_kinematics(m, data_.get());
  mj_comPos(m, data_.get());
  mj_crb(m, data_.get());
  Matrix inertia(m->nv, m->nv);
  mj_fullM(m, data_.get(), inertia.data());
  const Matrix whole = motion_.transpose() * inertia * motion_;
  const Index n = robot.size();
  const Eigen::LLT<Matrix> of_whole(whole);
  if (of_whole.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Matrix mobility =
      of_whole.solve(Matrix::Identity(whole.rows(), whole.rows())).topLeftCorner(n, n);
  const Matrix root = Eigen::LLT<Matrix>(whole.topLeftCorner(n, n)).matrixL();
  const Matrix gains = root.transpose() * mobility * root;
  return Eigen::SelfAdjointEigenSolver<Matrix>(gains, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

}  // namespace hurcules
