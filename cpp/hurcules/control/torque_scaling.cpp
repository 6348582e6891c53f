#include "hurcules/control/torque_scaling.hpp"

#include <algorithm>
#include <numeric>

namespace hurcules {

namespace {

// the share of this velocity that stays within its side of the bounds
double share_within(double velocity, double lower, double upper) {
  if (velocity > upper) return upper > 0.0 ? upper / velocity : 0.0;
  if (velocity < lower) return lower < 0.0 ? lower / velocity : 0.0;
  return 1.0;
}

// an inequality that holds nothing back
bool is_slack(const Level& level, Index row, const Vector& x) {
  constexpr double kTouches = 1e-9;
  const double lower = level.lower[row], upper = level.upper[row];
  const double margin = kTouches * (1.0 + std::abs(upper - lower));
  const double value = level.A.row(row).dot(x);
  return value > lower + margin && value < upper - margin;
}

}  // namespace

TorqueScaling::TorqueScaling(Index coordinates)
    : next_(static_cast<std::size_t>(coordinates)), share_(Vector::Ones(coordinates)) {}

Index TorqueScaling::part_of(Index i) const {
  while (next_[static_cast<std::size_t>(i)] != i) i = next_[static_cast<std::size_t>(i)];
  return i;
}

void TorqueScaling::tie(const Hierarchy& levels, const Vector& x) {
  std::iota(next_.begin(), next_.end(), Index{0});
  for (const Level& level : levels) {
    if (level.bounds) continue;
    for (Index row = 0; row < level.rows(); ++row) {
      if (is_slack(level, row, x)) continue;
      Index first = -1;
      for (Index i = 0; i < share_.size(); ++i) {
        if (level.A(row, i) == 0.0) continue;
        const Index part = part_of(i);
        if (first < 0) first = part;
        next_[static_cast<std::size_t>(part)] = first;
      }
    }
  }
}

bool TorqueScaling::apply(const VelocityBounds& bounds, const Hierarchy& levels, const Vector& x,
                          VectorRef velocity) {
  const Index n = share_.size();
  const auto own_share = [&](Index i) {
    return share_within(velocity[i], bounds.lower[i], bounds.upper[i]);
  };
  bool all_within = true;
  for (Index i = 0; i < n; ++i) all_within = all_within && own_share(i) == 1.0;
  if (all_within) return false;
  tie(levels, x);
  share_.setOnes();
  for (Index i = 0; i < n; ++i) {
    double& share = share_[part_of(i)];
    share = std::min(share, own_share(i));
  }
  for (Index i = 0; i < n; ++i) {
    const double share = share_[part_of(i)];
    if (share == 1.0) continue;
    velocity[i] = std::clamp(share * velocity[i], bounds.lower[i], bounds.upper[i]);
  }
  return true;
}

}  // namespace hurcules
