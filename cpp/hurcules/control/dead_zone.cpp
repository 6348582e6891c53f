#include "hurcules/control/dead_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hurcules {

namespace {

constexpr double kOpens = 0.02, kWide = 0.1;  // w at which a zone opens, and is open
constexpr double kNearLimit = 0.02;  // [rad] or [m] from a limit: a joint begins to be held
constexpr double kFreeJoint = 1e-6;  // what the rows above leave of a joint
constexpr double kRank = 1e-10;      // as the solver's
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
  known_.resize(n);
  held_ = Matrix::Zero(n, n);
  held_sources_.resize(static_cast<std::size_t>(n));
  pull_ = direction_ = held_shares_ = nudge_ = off_ = Vector::Zero(n);
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
  pressed_rows_.assign(shares_.size(), {});
  for (auto& own : pressed_rows_) own.reserve(nearness_.size() * static_cast<std::size_t>(rows));
}

void DeadZone::apply(std::span<const double> weights, std::span<const double> gains,
                     const JointLimits* limits, SaddleProbe* probe, Hierarchy& hierarchy) {
  known_.truncate(0);
  pressed_.setZero();
  for (auto& rows : pressed_rows_) rows.clear();
  nudge_.setZero();
  double above = 0.0;  // the largest w of the levels above
  double calm = 1.0;   // share that levels which have stopped leave to those below
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    Level& level = hierarchy[k];
    shares_[k] = 1.0;
    double below = 1.0;
    if (level.bounds) continue;
    const double open = std::clamp((weights[k] - kOpens) / (kWide - kOpens), 0.0, 1.0);
    const double eps = kZone + (kZoneBelow - kZone) * above;
    if (open > 0.0 && !(known_.rank() == 0 && apart_[k])) {
      const double slope = slope_of(k, hierarchy, limits);
      const double taken = slope > eps * open ? eps * open / slope : 1.0;
      shares_[k] = 1.0 - taken;
      const double looks = (1.0 - above) * std::clamp(taken / kLooks - 1.0, 0.0, 1.0);
      const Index above_here = known_.rank();
      keep_held();
      if (probe && looks > 0.0 && !apart_[k])
        shares_[k] += looks * taken * saddle_at(k, hierarchy, gains[k], *probe);
      if (shares_[k] < 1.0 && k + 1 < hierarchy.size()) {
        const double weakest = add_rows(level, kRank) / (eps * lever_);
        below = 1.0 - (1.0 - shares_[k]) * std::max(0.0, 1.0 - weakest);
      }
      known_.truncate(above_here);
    }
    shares_[k] *= calm;
    calm *= below;
    for (Index row = 0; row < level.rows(); ++row) {
      if (!is_equality(level, row)) continue;
      direction_ = level.A.row(row);
      level.upper[row] = level.lower[row] *= shares_[k];
      const double length = direction_.norm();
      if (k + 1 == hierarchy.size() || length == 0.0) continue;
      direction_ /= length;
      known_.add(direction_, {k, row});
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
  known_.remove_from(pull_);
  held_count_ = 0;
  if (limits) hold_pressed_joints(k, *limits);
  for (std::size_t j = 0; j < k; ++j)
    if (!hierarchy[j].bounds) hold_pressed_rows(k, j, hierarchy[j]);
  const double most = asked_ * lever_;
  return most > 0.0 ? pull_.norm() / most : std::numeric_limits<double>::infinity();
}

double DeadZone::saddle_at(std::size_t k, const Hierarchy& hierarchy, double gain,
                           SaddleProbe& probe) {
  const Index kept = known_.rank();
  add_rows(hierarchy[k], kWeak * lever_);
  off_ = pull_;
  known_.remove_from(off_);
  const double most = asked_ * lever_, length = off_.norm();
  double saddle = 0.0;
  if (length > kNoPull * most) {
    off_ /= length;
    saddle = saddle_along(k, hierarchy, kept, gain, probe);
  } else {
    for (Index i = 0; i < off_.size() && saddle < 1.0; ++i) {
      off_.setZero();
      off_[i] = 1.0;
      known_.remove_from(off_);
      if (off_.norm() < kFreeJoint) continue;
      off_ /= off_.norm();
      const double here = saddle_along(k, hierarchy, kept, gain, probe);
      if (here > saddle) nudge_ = here * kNudge * off_;
      saddle = std::max(saddle, here);
    }
  }
  known_.truncate(kept);
  return saddle;
}

double DeadZone::saddle_along(std::size_t k, const Hierarchy& hierarchy, Index kept, double gain,
                              SaddleProbe& probe) {
  if (!probe.move(off_, k + 1)) return 0.0;
  // what bends the way so that what is known stays as it is, one after the other
  direction_.setZero();
  for (Index j = 0; j < kept; ++j) {
    const auto [from, row] = known_.source(j);
    const bool joint = from == kJoint;
    const auto along = [&](const auto& v) {
      return joint ? v[row] : hierarchy[from].A.row(row).dot(v);
    };
    const double length = joint ? 1.0 : hierarchy[from].A.row(row).norm();
    const double leverage = along(known_.direction(j));
    if (leverage < kFreeJoint * length) continue;
    const double left = along(direction_) + (joint ? 0.0 : probe.drift(from)[row]);
    direction_ -= left / leverage * known_.direction(j).transpose();
  }
  const Level& level = hierarchy[k];
  double growth = 0.0;
  for (Index row = 0; row < level.rows(); ++row) {
    if (!is_equality(level, row)) continue;
    const auto a = level.A.row(row);
    const double rate = a.dot(off_);
    growth += level.lower[row] * (probe.drift(k)[row] + a.dot(direction_)) - gain * rate * rate;
  }
  const double d = growth / (asked_ * lever_);
  return std::clamp((d - kSaddleBegins) / (kSaddle - kSaddleBegins), 0.0, 1.0);
}

// to what is known: what limits hold, where they hold more than half of it
void DeadZone::keep_held() {
  for (Index j = 0; j < held_count_; ++j) {
    if (held_shares_[j] < 0.5) continue;
    direction_ = held_.row(j);
    known_.add(direction_, held_sources_[static_cast<std::size_t>(j)]);
  }
}

// to what is known: the directions that the equality rows move in by `least` or more, the strongest
// that is left first; what the weakest of them moves
double DeadZone::add_rows(const Level& level, double least) {
  auto left = left_.topRows(level.rows());
  for (Index row = 0; row < level.rows(); ++row) {
    left.row(row).setZero();
    if (is_equality(level, row)) left.row(row) = level.A.row(row);
  }
  return known_.add_rows(left, least, lever_);
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
    hold_direction(held, {kJoint, i});
  }
}

// the same for the inequality rows of a level, which say how fast they may come nearer
void DeadZone::hold_pressed_rows(std::size_t k, std::size_t above, const Level& level) {
  for (Index row = 0; row < level.rows(); ++row) {
    if (!nearness_[above][static_cast<std::size_t>(row)] || is_equality(level, row)) continue;
    const double nearest = std::min(level.upper[row], -level.lower[row]);
    if (nearest == std::numeric_limits<double>::infinity()) continue;
    const double length = level.A.row(row).norm();
    if (length < kFreeJoint || nearest / length >= kSlow) continue;
    direction_ = level.A.row(row) / length;
    const double along = direction_.dot(pull_);
    const double room = (along > 0.0 ? level.upper[row] : -level.lower[row]) / length;
    const double held = std::min(1.0, 1.0 - room / kSlow);
    if (!(held > 0.0) || along == 0.0) continue;
    if (held > 0.5) pressed_rows_[k].emplace_back(above, row);
    hold_direction(held, {above, row});
  }
}

// takes so much of direction_, of length 1, from the pull
void DeadZone::hold_direction(double share, OrthonormalRows::Source from) {
  if (known_.rank() + held_count_ == held_.rows()) return;
  known_.remove_from(direction_);
  for (Index j = 0; j < held_count_; ++j)
    direction_ -= held_shares_[j] * held_.row(j).dot(direction_) * held_.row(j).transpose();
  const double length = direction_.norm();
  if (length < kFreeJoint) return;
  direction_ /= length;
  pull_ -= share * direction_.dot(pull_) * direction_;
  held_shares_[held_count_] = share;
  held_sources_[static_cast<std::size_t>(held_count_)] = from;
  held_.row(held_count_++) = direction_;
}

}  // namespace hurcules
