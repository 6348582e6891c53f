#include "hurcules/control/dead_zone.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

constexpr double kOpens = 0.02, kWide = 0.1;  // w at which a zone opens, and is open
constexpr double kNearLimit = 0.02;  // [rad] or [m] from a limit: a joint begins to be held
constexpr double kFreeJoint = 1e-6;  // what the rows above leave of a joint
constexpr double kRank = 1e-10;      // as the solver's, of rows of length 1

bool is_equality(const Level& level, Index row) {
  return level.lower[row] == level.upper[row];
}

}  // namespace

void DeadZone::set_stack(const Stack& stack, Index n) {
  known_ = Matrix::Zero(n, n);
  pull_ = direction_ = parts_ = held_ = Vector::Zero(n);
  shares_.assign(stack.levels().size(), 1.0);
  pressed_ = Eigen::MatrixXi::Zero(static_cast<Index>(shares_.size()), n);
  apart_.clear();
  for (const StackLevel& level : stack.levels()) {
    apart_.push_back(std::all_of(level.tasks.begin(), level.tasks.end(),
                                 [](const Task* task) { return task->rows_apart(); }));
  }
}

void DeadZone::apply(std::span<const double> weights, const Task* limits, Hierarchy& hierarchy) {
  rank_ = 0;
  pressed_.setZero();
  double above = 0.0;  // the largest w of the levels above
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    Level& level = hierarchy[k];
    shares_[k] = 1.0;
    if (level.bounds) continue;
    const double open = std::clamp((weights[k] - kOpens) / (kWide - kOpens), 0.0, 1.0);
    const double eps = kZone + (kZoneBelow - kZone) * above;
    if (open > 0.0 && !(rank_ == 0 && apart_[k]))
      shares_[k] = share_of(k, level, eps * open, limits);
    for (Index row = 0; row < level.rows(); ++row) {
      if (!is_equality(level, row)) continue;
      direction_ = level.A.row(row);
      level.upper[row] = level.lower[row] *= shares_[k];
      const double length = direction_.norm();
      if (k + 1 == hierarchy.size() || length == 0.0) continue;
      direction_ /= length;
      add_direction();
    }
    above = std::max(above, weights[k]);
  }
}

void DeadZone::add_held(Eigen::VectorXi& held) const {
  for (Index i = 0; i < held.size(); ++i) {
    for (std::size_t k = 0; held[i] == 0 && k < shares_.size(); ++k)
      if (shares_[k] < 0.5) held[i] = pressed(k, i);
  }
}

double DeadZone::share_of(std::size_t k, const Level& level, double zone, const Task* limits) {
  find_pull(level);
  const double most = asked_ * lever_;
  if (most == 0.0) return 1.0;
  remove_known(pull_);
  if (limits) hold_pressed_joints(k, *limits);
  const double slope = pull_.norm() / most;
  return slope > zone ? 1.0 - zone / slope : 0.0;
}

// A'y, |y| and S of the equality rows
void DeadZone::find_pull(const Level& level) {
  pull_.setZero();
  direction_.setZero();
  asked_ = 0.0;
  for (Index row = 0; row < level.rows(); ++row) {
    if (!is_equality(level, row)) continue;
    const double y = level.lower[row];
    pull_ += y * level.A.row(row).transpose();
    direction_ += level.A.row(row).transpose().cwiseAbs2();
    asked_ += y * y;
  }
  asked_ = std::sqrt(asked_);
  lever_ = std::sqrt(direction_.maxCoeff());
}

// takes from the pull what presses joints against their limits, the more the nearer they are
void DeadZone::hold_pressed_joints(std::size_t k, const Task& limits) {
  Index last = rank_;
  for (Index i = 0; i < pull_.size() && last < known_.rows(); ++i) {
    const double q = limits.error()[i];
    const double distance = pull_[i] > 0.0 ? limits.upper()[i] - q : q - limits.lower()[i];
    const double held = 1.0 - std::max(0.0, distance) / kNearLimit;
    if (!(held > 0.0) || pull_[i] == 0.0) continue;
    pressed_(static_cast<Index>(k), i) = held < 0.5 ? 0 : pull_[i] > 0.0 ? 1 : -1;
    direction_.setZero();
    direction_[i] = 1.0;
    remove_known(direction_);
    for (Index j = rank_; j < last; ++j)
      direction_ -= held_[j] * known_.row(j).dot(direction_) * known_.row(j).transpose();
    const double length = direction_.norm();
    if (length < kFreeJoint) continue;
    direction_ /= length;
    pull_ -= held * direction_.dot(pull_) * direction_;
    held_[last] = held;
    known_.row(last++) = direction_;
  }
}

// direction_, of length 1, unless it is known already
void DeadZone::add_direction() {
  if (rank_ == known_.rows()) return;
  remove_known(direction_);
  double length = direction_.norm();
  if (length < kRank) return;
  direction_ /= length;
  if (length < 0.5) {  // what cancelled left rounding behind
    remove_known(direction_);
    length = direction_.norm();
    direction_ /= length;
  }
  known_.row(rank_++) = direction_;
}

void DeadZone::remove_known(VectorRef direction) {
  const auto known = known_.topRows(rank_);
  auto parts = parts_.head(rank_);
  parts.noalias() = known * direction;
  direction.noalias() -= known.transpose() * parts;
}

}  // namespace hurcules
