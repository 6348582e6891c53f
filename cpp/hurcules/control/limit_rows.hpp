// Rows that are limits (Task::is_limit): distances, say. They are approached as joint limits are.
//
//   J qdot >= velocity_des - f(d)      d: distance to the side, f: approach speed of rate_interval.hpp
// with the acceleration a |J_i|_1 / 2: half of what all coordinates together have along the row. The
// other half is left for what f does not know: the turning of J, other rows, tasks above. A task with a
// gain of its own has the horizon 1 / gain.
//
// Most of them cannot become active in a tick: no velocity within the bounds of the coordinates moves
// along them as fast as they allow. Without their limits the answer is the same, and sooner found.
#pragma once

#include <span>

#include "hurcules/control/rate_interval.hpp"
#include "hurcules/control/stack.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

// every task of the level is a limit
[[nodiscard]] bool are_limits(const StackLevel& level);

// `limits` of a coordinate; fills both sides of J qdot, (m) [unit/s]
void limit_rates(const Task& task, const RateLimits& limits, VectorRef lower, VectorRef upper);

// the same for J qddot + drift, at the rates J qdot of the rows (m) [unit/s^2]
void limit_accelerations(const Task& task, const RateLimits& limits, const ConstVectorRef& rates,
                         VectorRef lower, VectorRef upper);

// What rows reach while each unknown is within its bounds.
class Reachable {
 public:
  explicit Reachable(Index n) : middle_(Vector::Zero(n)), half_(middle_) {}
  void set(const Level& bounds);  // simple bounds (n)
  // takes the limits from inequality rows that no x within the bounds brings there
  void drop_others(Level& level) const;

 private:
  Vector middle_, half_;  // (n)
};

// Changes a velocity (n) by little, within the intervals of the coordinates (n), so that
// lower <= A velocity <= upper (m): by projection on one row after the other.
void hold_rows(const Matrix& A, const ConstVectorRef& lower, const ConstVectorRef& upper,
               std::span<const RateInterval> intervals, VectorRef velocity);

}  // namespace hurcules
