#include "hurcules/control/dead_zone.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

constexpr double kOpens = 0.02, kWide = 0.1;  // w at which a zone opens, and is open
constexpr double kAtLimit = 5e-5;             // [rad] or [m] from a limit: a joint stands at it
constexpr double kRank = 1e-10;               // as the solver's, of rows of length 1

bool is_equality(const Level& level, Index row) {
  return level.lower[row] == level.upper[row];
}

}  // namespace

void DeadZone::reserve(Index n, std::size_t levels) {
  shares_.assign(levels, 1.0);
  known_ = Matrix::Zero(n, n);
  pull_ = direction_ = parts_ = Vector::Zero(n);
}

void DeadZone::apply(std::span<const double> weights, const Task* limits, Hierarchy& hierarchy) {
  rank_ = 0;
  double above = 0.0;  // the largest w of the levels above
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    Level& level = hierarchy[k];
    shares_[k] = 1.0;
    if (level.bounds) continue;
    const double open = std::clamp((weights[k] - kOpens) / (kWide - kOpens), 0.0, 1.0);
    const double eps = kZone + (kZoneBelow - kZone) * above;
    if (open > 0.0) shares_[k] = share_of(level, eps * open, limits);
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

double DeadZone::share_of(const Level& level, double zone, const Task* limits) {
  find_pull(level);
  const double most = asked_ * lever_;
  if (most == 0.0) return 1.0;
  remove_known(pull_);
  const Index rank = rank_;
  if (limits) hold_pressed_joints(*limits);
  if (rank_ > rank) remove_known(pull_);
  rank_ = rank;
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

void DeadZone::hold_pressed_joints(const Task& limits) {
  for (Index i = 0; i < pull_.size(); ++i) {
    const double q = limits.error()[i];
    const bool pressed = (pull_[i] > 0.0 && limits.upper()[i] - q < kAtLimit) ||
                         (pull_[i] < 0.0 && q - limits.lower()[i] < kAtLimit);
    if (!pressed) continue;
    direction_.setZero();
    direction_[i] = 1.0;
    add_direction();
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
