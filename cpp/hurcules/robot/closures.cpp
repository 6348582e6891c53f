#include "hurcules/robot/closures.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/coordinates.hpp"

namespace hurcules {
namespace {

constexpr int kMostRows = 6;  // of a constraint
constexpr int kIterations = 20;
constexpr double kClosed = 1e-12;   // [m] or [rad]
constexpr double kNoShare = 1e-9;   // a column of C below it is rounding
constexpr double kDamping = 1e-10;  // of C_f' C_f, of its largest diagonal element
constexpr double kLongest = 0.2;    // [rad] or [m] of a step towards the closed loop
constexpr double kAside = 0.05;     // [rad] or [m] off the model's first posture
constexpr double kAhead = 1e-6;     // [s] for dC/dt

// equality constraints and nothing else, in full matrices
std::unique_ptr<mjModel, void (*)(mjModel*)> of_constraints(const mjModel& model) {
  auto* const m = new mjModel(model);
  m->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS;
  m->opt.disableflags &= ~(mjDSBL_CONSTRAINT | mjDSBL_EQUALITY);
  m->opt.jacobian = mjJAC_DENSE;
  return {m, [](mjModel* copy) { delete copy; }};
}

int dofs_of(const mjModel& m, int joint) {
  switch (m.jnt_type[joint]) {
    case mjJNT_FREE:
      return 6;
    case mjJNT_BALL:
      return 3;
    default:
      return 1;
  }
}

// of at most kMostRows rows: flexible bodies have other constraints
bool is_known(const mjModel& m, int equality) {
  const int type = m.eq_type[equality];
  return type == mjEQ_CONNECT || type == mjEQ_WELD || type == mjEQ_JOINT || type == mjEQ_TENDON;
}

bool meet(const std::vector<bool>& a, const std::vector<bool>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i]) return true;
  return false;
}

}  // namespace

Closures::Closures(const mjModel& model, const std::vector<Coordinate>& coordinates, bool chosen)
    : model_(of_constraints(model)),
      data_(nullptr, mj_deleteData),
      loops_(static_cast<std::size_t>(model.neq), false),
      felt_(static_cast<std::size_t>(model.nv), false) {
  for (const Coordinate& coordinate : coordinates) {
    coordinates_.emplace_back();
    for (const DrivenJoint& joint : coordinate.joints)
      coordinates_.back().emplace_back(joint.dof, joint.factor);
  }
  if (model.neq == 0 || coordinates.empty()) return;
  full_ = Vector::Zero(model.nv);
  ahead_ = Vector::Zero(model.nq);
  data_.reset(mj_makeData(model_.get()));
  require(data_ != nullptr, "MuJoCo has no memory for this model");
  find(chosen);
  const auto n = static_cast<Index>(coordinates_.size());
  normal_ = Matrix::Zero(size(), size());
  share_ = Matrix::Zero(size(), n);
  drift_ = step_ = right_ = Vector::Zero(size());
}

Closures::~Closures() = default;

bool Closures::keeps(int equality) const {
  return loops_[static_cast<std::size_t>(equality)];
}

// from the coordinates on, constraint by constraint
void Closures::find(bool chosen) {
  const mjModel& m = *model_;
  std::vector<bool> moves(static_cast<std::size_t>(m.nv), false), may = joints_that_may(chosen);
  for (const auto& joints : coordinates_) {
    for (const auto& [dof, factor] : joints) {
      moves[static_cast<std::size_t>(dof)] = true;
      may[static_cast<std::size_t>(dof)] = false;
    }
  }
  // the first posture may hide what a constraint touches: an axis through an anchor
  Vector qpos = Eigen::Map<const Vector>(m.qpos0, m.nq);
  const Vector aside = Vector::Constant(m.nv, kAside);
  mj_integratePos(&m, qpos.data(), aside.data(), 1.0);
  for (int i = 0; i < m.neq; ++i) loops_[static_cast<std::size_t>(i)] = is_known(m, i);
  C_ = C_f_ = Matrix::Zero(kMostRows * m.neq, m.nv);
  c_ = rate_ = Vector::Zero(kMostRows * m.neq);
  linearize(qpos.data());
  // (neq, nv) the constraint moves with the joint
  std::vector<std::vector<bool>> touched(loops_.size(), std::vector<bool>(may.size(), false));
  for (int efc = 0, row = 0; efc < data_->ne; ++efc) {
    const auto equality = static_cast<std::size_t>(data_->efc_id[efc]);
    if (!loops_[equality]) continue;
    for (std::size_t dof = 0; dof < may.size(); ++dof)
      if (std::abs(C_(row, static_cast<Index>(dof))) > kNoShare) touched[equality][dof] = true;
    ++row;
  }
  std::fill(loops_.begin(), loops_.end(), false);
  for (bool found = true; found;) {
    found = false;
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      if (loops_[i] || !meet(touched[i], moves) || !meet(touched[i], may)) continue;
      loops_[i] = found = true;
      for (std::size_t dof = 0; dof < may.size(); ++dof) {
        felt_[dof] = felt_[dof] || touched[i][dof];
        if (touched[i][dof] && may[dof]) take(m.dof_jntid[dof], moves, may);
      }
    }
  }
  std::sort(followers_.begin(), followers_.end(),
            [](const Follower& a, const Follower& b) { return a.dof < b.dof; });
  C_f_ = Matrix::Zero(C_.rows(), size());
}

// without an actuator, or chosen, and without a spring; of the coordinates' trees no root: (nv)
std::vector<bool> Closures::joints_that_may(bool chosen) const {
  const mjModel& m = *model_;
  std::vector<bool> may(static_cast<std::size_t>(m.nv), false);
  std::vector<bool> is_robot(static_cast<std::size_t>(m.nbody), false);
  for (const auto& joints : coordinates_)
    for (const auto& [dof, factor] : joints)
      is_robot[static_cast<std::size_t>(m.body_rootid[m.dof_bodyid[dof]])] = true;
  for (int j = 0; j < m.njnt; ++j) {
    const auto tree = static_cast<std::size_t>(m.body_rootid[m.jnt_bodyid[j]]);
    const bool root = m.jnt_type[j] == mjJNT_FREE && is_robot[tree];
    const bool idle = m.jnt_stiffness[j] == 0.0 && (chosen || actuator_of(m, j) < 0);
    for (int k = 0; !root && idle && k < dofs_of(m, j); ++k)
      may[static_cast<std::size_t>(m.jnt_dofadr[j] + k)] = true;
  }
  return may;
}

// a joint follows from here on, all of a ball or a free joint
void Closures::take(int joint, std::vector<bool>& moves, std::vector<bool>& may) {
  for (int k = 0; k < dofs_of(*model_, joint); ++k) {
    const int dof = model_->jnt_dofadr[joint] + k;
    may[static_cast<std::size_t>(dof)] = false;
    moves[static_cast<std::size_t>(dof)] = true;
    followers_.push_back(follower(dof));
  }
}

Closures::Follower Closures::follower(int dof) const {
  const mjModel& m = *model_;
  const int joint = m.dof_jntid[dof];
  const bool limited = m.jnt_limited[joint] && dofs_of(m, joint) == 1;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  return {joint_name(m, joint), dof, m.jnt_qposadr[joint],
          limited ? m.jnt_range[2 * joint] : -kNone, limited ? m.jnt_range[2 * joint + 1] : kNone};
}

void Closures::linearize(const double* qpos) {
  const mjModel& m = *model_;
  mjData* const d = data_.get();
  std::copy_n(qpos, m.nq, d->qpos);
  mj_kinematics(&m, d);
  mj_comPos(&m, d);
  if (m.ntendon > 0) mj_tendon(&m, d);
  mj_makeConstraint(&m, d);
  rows_ = 0;
  for (int row = 0; row < d->ne; ++row) {
    if (!loops_[static_cast<std::size_t>(d->efc_id[row])]) continue;
    for (int dof = 0; dof < m.nv; ++dof) C_(rows_, dof) = d->efc_J[row * m.nv + dof];
    for (Index f = 0; f < size(); ++f) C_f_(rows_, f) = C_(rows_, dof(f));
    c_[rows_++] = d->efc_pos[row];
  }
  error_ = rows_ > 0 ? c_.head(rows_).cwiseAbs().maxCoeff() : 0.0;
  if (size() == 0) return;
  const auto C_f = C_f_.topRows(rows_);
  normal_.noalias() = C_f.transpose() * C_f;
  normal_.diagonal().array() += kDamping * std::max(normal_.diagonal().maxCoeff(), kDamping);
  factor_.compute(normal_);
}

void Closures::measure(const double* qpos) {
  linearize(qpos);
  find_share();
}

void Closures::find_share() {
  for (Index i = 0; i < share_.cols(); ++i) {
    right_.setZero();
    for (const auto& [dof, factor] : coordinates_[static_cast<std::size_t>(i)])
      right_.noalias() -= factor * (C_f_.topRows(rows_).transpose() * C_.col(dof).head(rows_));
    share_.col(i) = right_;
  }
  factor_.solveInPlace(share_);
  drift_.setZero();
  slack_ = 0.0;
  for (Index i = 0; i < share_.cols(); ++i) {
    rate_.head(rows_).noalias() = C_f_.topRows(rows_) * share_.col(i);
    for (const auto& [dof, factor] : coordinates_[static_cast<std::size_t>(i)])
      rate_.head(rows_) += factor * C_.col(dof).head(rows_);
    slack_ = std::max(slack_, rate_.head(rows_).cwiseAbs().maxCoeff());
  }
}

void Closures::close(double* qpos, const Vector& change) {
  step_.noalias() = share_ * change;
  move(qpos, step_);
  linearize(qpos);
  for (int i = 0; i < kIterations && error_ >= kClosed; ++i) {
    step_.noalias() = -C_f_.topRows(rows_).transpose() * c_.head(rows_);
    factor_.solveInPlace(step_);
    move(qpos, step_);
    linearize(qpos);
  }
  find_share();
}

void Closures::move(double* qpos, const Vector& step) {
  const double longest = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0.0;
  const double share = longest > kLongest ? kLongest / longest : 1.0;
  full_.setZero();
  for (Index f = 0; f < size(); ++f) full_[dof(f)] = share * step[f];
  mj_integratePos(model_.get(), qpos, full_.data(), 1.0);
}

void Closures::set_velocity(const double* qpos, const double* qvel) {
  const mjModel& m = *model_;
  drift_.setZero();
  const Eigen::Map<const Vector> velocity(qvel, m.nv);
  if (size() == 0 || velocity.isZero(0.0)) return;
  std::copy_n(qpos, m.nq, ahead_.data());
  mj_integratePos(&m, ahead_.data(), qvel, kAhead);
  linearize(ahead_.data());
  rate_.head(rows_).noalias() = C_.topRows(rows_) * velocity;
  linearize(qpos);
  rate_.head(rows_).noalias() -= C_.topRows(rows_) * velocity;
  drift_.noalias() = C_f_.topRows(rows_).transpose() * rate_.head(rows_);
  drift_ /= -kAhead;
  factor_.solveInPlace(drift_);
}

}  // namespace hurcules
