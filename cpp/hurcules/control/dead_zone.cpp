#include "hurcules/control/dead_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hurcules {

namespace {

constexpr double kOpens = 0.02, kWide = 0.1;  // w at which a zone opens, and is open
constexpr double kNearLimit = 0.02;  // [rad] or [m] from a limit: a joint begins to be held
constexpr double kFreeJoint = 1e-6;  // what the rows above leave of a joint
constexpr double kRank = 1e-10;      // as the solver's, of rows of length 1
constexpr double kSaddleBegins = 0.025, kSaddle = 0.075;  // d [1/rad]
constexpr double kLooks = 0.05;   // share that a zone takes from which on a saddle is looked for
constexpr double kNoPull = 1e-7;  // slope below which the pull has no direction
constexpr double kWeak = 0.03;    // of S: a row that moves no more may vanish at a saddle
constexpr double kLever = 1e-3;   // S at least: where all rows vanish, a saddle is looked for
constexpr double kSlow = 0.3;     // [rad/s] that a row may come nearer: it begins to be held
constexpr double kNudge = 0.02;   // [rad/s]

bool is_equality(const Level& level, Index row) {
  return level.lower[row] == level.upper[row];
}

}  // namespace

void DeadZone::set_stack(const Stack& stack, Index n) {
  known_ = Matrix::Zero(n, n);
  pull_ = direction_ = parts_ = held_ = nudge_ = off_ = Vector::Zero(n);
  shares_.assign(stack.levels().size(), 1.0);
  pressed_ = Eigen::MatrixXi::Zero(static_cast<Index>(shares_.size()), n);
  apart_.clear();
  tasks_.clear();
  nearness_.clear();
  Index rows = 0;
  for (const StackLevel& level : stack.levels()) {
    apart_.push_back(std::all_of(level.tasks.begin(), level.tasks.end(),
                                 [](const Task* task) { return task->rows_apart(); }));
    tasks_.emplace_back(level.tasks.begin(), level.tasks.end());
    Index sum = 0;
    std::vector<bool>& nearness = nearness_.emplace_back();
    for (const Task* task : level.tasks) {
      sum += task->rows();
      nearness.resize(static_cast<std::size_t>(sum), !task->bounds_acceleration());
    }
    rows = std::max(rows, sum);
  }
  left_ = Matrix::Zero(rows, n);
}

void DeadZone::apply(std::span<const double> weights, std::span<const double> gains,
                     const JointLimits* limits, SaddleProbe* probe, Hierarchy& hierarchy) {
  rank_ = 0;
  pressed_.setZero();
  nudge_.setZero();
  double above = 0.0;  // the largest w of the levels above
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    Level& level = hierarchy[k];
    shares_[k] = 1.0;
    if (level.bounds) continue;
    const double open = std::clamp((weights[k] - kOpens) / (kWide - kOpens), 0.0, 1.0);
    const double eps = kZone + (kZoneBelow - kZone) * above;
    if (open > 0.0 && !(rank_ == 0 && apart_[k])) {
      const double slope = slope_of(k, hierarchy, limits);
      const double taken = slope > eps * open ? eps * open / slope : 1.0;
      shares_[k] = 1.0 - taken;
      const double looks = (1.0 - above) * std::clamp(taken / kLooks - 1.0, 0.0, 1.0);
      if (probe && looks > 0.0 && !apart_[k])
        shares_[k] += looks * taken * saddle_at(k, level, gains[k], *probe);
    }
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

double DeadZone::slope_of(std::size_t k, const Hierarchy& hierarchy, const JointLimits* limits) {
  find_pull(hierarchy[k], tasks_[k]);
  remove_known(pull_);
  last_ = rank_;
  if (limits) hold_pressed_joints(k, *limits);
  for (std::size_t j = 0; j < k; ++j)
    if (!hierarchy[j].bounds) hold_pressed_rows(hierarchy[j], nearness_[j]);
  const double most = asked_ * lever_;
  return most > 0.0 ? pull_.norm() / most : std::numeric_limits<double>::infinity();
}

double DeadZone::saddle_at(std::size_t k, const Level& level, double gain, SaddleProbe& probe) {
  const Index above = rank_;
  add_strong_rows(level);
  off_ = pull_;
  remove_known(off_);
  const double most = asked_ * lever_, length = off_.norm();
  double saddle = 0.0;
  if (length > kNoPull * most) {
    off_ /= length;
    saddle = saddle_along(k, level, gain, probe);
  } else {
    for (Index i = 0; i < off_.size() && saddle < 1.0; ++i) {
      off_.setZero();
      off_[i] = 1.0;
      remove_known(off_);
      if (off_.norm() < kFreeJoint) continue;
      off_ /= off_.norm();
      const double here = saddle_along(k, level, gain, probe);
      if (here > saddle) nudge_ = here * kNudge * off_;
      saddle = std::max(saddle, here);
    }
  }
  rank_ = above;
  return saddle;
}

double DeadZone::saddle_along(std::size_t k, const Level& level, double gain, SaddleProbe& probe) {
  const double d = probe.growth(k, level, off_, gain) / (asked_ * lever_);
  return std::clamp((d - kSaddleBegins) / (kSaddle - kSaddleBegins), 0.0, 1.0);
}

// to what is known: the directions that the equality rows move in by more than `kWeak` of the lever
// each, the strongest that is left first
void DeadZone::add_strong_rows(const Level& level) {
  auto left = left_.topRows(level.rows());
  for (Index row = 0; row < level.rows(); ++row) {
    direction_.setZero();
    if (is_equality(level, row)) direction_ = level.A.row(row);
    remove_known(direction_);
    left.row(row) = direction_;
  }
  for (Index count = 0; count < level.rows() && rank_ < known_.rows(); ++count) {
    Index strongest = 0;
    const double length = std::sqrt(left.rowwise().squaredNorm().maxCoeff(&strongest));
    if (length < kWeak * lever_) return;
    known_.row(rank_) = left.row(strongest) / length;
    for (Index row = 0; row < level.rows(); ++row)
      left.row(row) -= left.row(row).dot(known_.row(rank_)) * known_.row(rank_);
    ++rank_;
  }
}

// A'y, |y| and S of the equality rows
void DeadZone::find_pull(const Level& level, const std::vector<const Task*>& tasks) {
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
  lever_ = std::max(kLever, std::sqrt(direction_.maxCoeff()));
  for (const Task* task : tasks) lever_ = std::max(lever_, task->lever());
}

// takes from the pull what presses joints against their limits, the more the nearer they are
void DeadZone::hold_pressed_joints(std::size_t k, const JointLimits& limits) {
  for (Index i = 0; i < pull_.size(); ++i) {
    const double q = limits.configuration()[i];
    const double distance = pull_[i] > 0.0 ? limits.upper()[i] - q : q - limits.lower()[i];
    const double held = 1.0 - std::max(0.0, distance) / kNearLimit;
    if (!(held > 0.0) || pull_[i] == 0.0) continue;
    pressed_(static_cast<Index>(k), i) = held < 0.5 ? 0 : pull_[i] > 0.0 ? 1 : -1;
    direction_.setZero();
    direction_[i] = 1.0;
    hold_direction(held);
  }
}

// the same for the inequality rows of a level, which say how fast they may come nearer
void DeadZone::hold_pressed_rows(const Level& level, const std::vector<bool>& nearness) {
  for (Index row = 0; row < level.rows(); ++row) {
    if (!nearness[static_cast<std::size_t>(row)] || is_equality(level, row)) continue;
    const double length = level.A.row(row).norm();
    if (length < kFreeJoint) continue;
    direction_ = level.A.row(row) / length;
    const double along = direction_.dot(pull_);
    const double room = (along > 0.0 ? level.upper[row] : -level.lower[row]) / length;
    const double held = std::min(1.0, 1.0 - room / kSlow);
    if (held > 0.0 && along != 0.0) hold_direction(held);
  }
}

// takes so much of direction_, of length 1, from the pull
void DeadZone::hold_direction(double held) {
  if (last_ == known_.rows()) return;
  remove_known(direction_);
  for (Index j = rank_; j < last_; ++j)
    direction_ -= held_[j] * known_.row(j).dot(direction_) * known_.row(j).transpose();
  const double length = direction_.norm();
  if (length < kFreeJoint) return;
  direction_ /= length;
  pull_ -= held * direction_.dot(pull_) * direction_;
  held_[last_] = held;
  known_.row(last_++) = direction_;
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
  for (Index j = 0; j < rank_; ++j) parts_[j] = known_.row(j).dot(direction);
  for (Index j = 0; j < rank_; ++j) direction -= parts_[j] * known_.row(j).transpose();
}

}  // namespace hurcules
