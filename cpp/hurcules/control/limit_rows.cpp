#include "hurcules/control/limit_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/control/acceleration_interval.hpp"

namespace hurcules {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kBraking = 0.5;  // share of the acceleration along a row that f counts on
constexpr int kSweeps = 20;
constexpr double kHeld = 1e-12;    // [unit/s]
constexpr double kOutside = 1e-6;  // [rad/s] x may be outside of its bounds by less: rounding

// of one row; max_velocity: none
RateLimits along_row(const Task& task, Index row, const RateLimits& limits) {
  RateLimits along = limits;
  along.max_velocity = kUnlimited;
  along.max_acceleration =
      kBraking * limits.max_acceleration * task.jacobian().row(row).lpNorm<1>();
  along.return_speed = std::min(limits.return_speed, task.max_speed());
  along.horizon = std::max(1.0 / task.gain(row, 1.0 / limits.horizon), limits.dt);
  return along;
}

RateState state_of(const Task& task, Index row, double rate) {
  const double e = task.error()[row];
  return {task.lower()[row] - e, task.upper()[row] - e, rate - task.velocity_des()[row]};
}

bool asks(const Task& task, Index row) {
  return (task.jacobian().row(row).array() != 0.0).any();
}

// by how much a row is to be changed
double missing(const Matrix& A, Index row, double lower, double upper, const VectorRef& velocity) {
  const double rate = A.row(row).dot(velocity);
  return std::clamp(rate, lower, upper) - rate;
}

}  // namespace

bool are_limits(const StackLevel& level) {
  return std::all_of(level.tasks.begin(), level.tasks.end(),
                     [](const Task* task) { return task->is_limit(); });
}

void limit_rates(const Task& task, const RateLimits& limits, VectorRef lower, VectorRef upper) {
  for (Index row = 0; row < task.rows(); ++row) {
    lower[row] = -kUnlimited;
    upper[row] = kUnlimited;
    if (!asks(task, row)) continue;
    const RateLimits along = along_row(task, row, limits);
    const RateState state = state_of(task, row, 0.0);
    const auto speed = [&](double distance) {
      return distance < kUnlimited ? approach_speed(distance, along) : distance;
    };
    upper[row] = task.velocity_des()[row] + speed(state.to_upper);
    lower[row] = task.velocity_des()[row] - speed(-state.to_lower);
    lower[row] = std::min(lower[row], upper[row]);
  }
}

void limit_accelerations(const Task& task, const RateLimits& limits, const ConstVectorRef& rates,
                         VectorRef lower, VectorRef upper) {
  for (Index row = 0; row < task.rows(); ++row) {
    lower[row] = -kUnlimited;
    upper[row] = kUnlimited;
    if (!asks(task, row)) continue;
    const RateLimits along = along_row(task, row, limits);
    const RateState state = state_of(task, row, rates[row]);
    const double v = state.velocity, most = along.max_acceleration / kBraking;
    const double fastest = next_speed(state.to_upper, v, along);
    const double slowest = std::min(-next_speed(-state.to_lower, -v, along), fastest);
    if (std::isfinite(state.to_upper))
      upper[row] = std::clamp((fastest - v) / limits.dt, -most, most);
    if (std::isfinite(state.to_lower))
      lower[row] = std::clamp((slowest - v) / limits.dt, -most, most);
  }
}

void Reachable::set(const Level& bounds) {
  middle_ = 0.5 * (bounds.lower + bounds.upper);
  half_ = (0.5 * (bounds.upper - bounds.lower)).array() + kOutside;
}

void Reachable::drop_others(Level& level) const {
  for (Index row = 0; row < level.rows(); ++row) {
    double &lower = level.lower[row], &upper = level.upper[row];
    if (lower == upper || (lower == -kUnlimited && upper == kUnlimited)) continue;
    const double middle = level.A.row(row).dot(middle_);
    const double half = level.A.row(row).cwiseAbs().dot(half_);
    if (!(middle - half > lower && middle + half < upper)) continue;  // also where it is no number
    lower = -kUnlimited;
    upper = kUnlimited;
  }
}

void hold_rows(const Matrix& A, const ConstVectorRef& lower, const ConstVectorRef& upper,
               std::span<const RateInterval> intervals, VectorRef velocity) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double worst = 0.0;
    for (Index row = 0; row < A.rows(); ++row) {
      if (lower[row] == -kUnlimited && upper[row] == kUnlimited) continue;
      const double change = missing(A, row, lower[row], upper[row], velocity);
      if (std::abs(change) <= kHeld) continue;
      worst = std::max(worst, std::abs(change));
      // along the coordinates that may still go that way
      const auto is_free = [&](Index i) {
        const RateInterval& interval = intervals[static_cast<std::size_t>(i)];
        const double way = change * A(row, i);
        return way > 0.0 ? velocity[i] < interval.upper : way < 0.0 && velocity[i] > interval.lower;
      };
      double square = 0.0;
      for (Index i = 0; i < velocity.size(); ++i)
        if (is_free(i)) square += A(row, i) * A(row, i);
      if (square == 0.0) continue;
      for (Index i = 0; i < velocity.size(); ++i) {
        if (!is_free(i)) continue;
        const RateInterval& interval = intervals[static_cast<std::size_t>(i)];
        velocity[i] =
            std::clamp(velocity[i] + change / square * A(row, i), interval.lower, interval.upper);
      }
    }
    if (worst <= kHeld) return;
  }
}

}  // namespace hurcules
