#include "hurcules/control/rate_changes.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

void RateChanges::set_stack(const Stack& stack) {
  last_.clear();
  Index most = 0;
  for (const StackLevel& level : stack.levels()) {
    last_.emplace_back();
    for (const Task* task : level.tasks) {
      last_.back().push_back({Vector::Zero(task->rows())});
      most = std::max(most, task->rows());
    }
  }
  change_ = Vector::Zero(most);
}

void RateChanges::forget() {
  for (std::vector<Asked>& level : last_)
    for (Asked& asked : level) asked.known = false;
}

void RateChanges::limit(std::size_t k, std::size_t i, const Task& task, const Vector& velocity,
                        double dt, VectorRef lower, VectorRef upper) {
  Asked& last = last_[k][i];
  const double allowed = task.max_acceleration() * dt;
  if (std::isinf(allowed)) {
    last.known = false;
    return;
  }
  if (!last.known) {
    last.rate.noalias() = task.jacobian().leftCols(velocity.size()) * velocity;
    last.rate -= task.velocity_des();
    last.known = true;
  }
  auto change = change_.head(task.rows());
  double together = 0.0;
  for (Index row = 0; row < task.rows(); ++row) {
    const bool point = lower[row] == upper[row] && task.weights()[row] > 0.0;
    change[row] = point ? lower[row] - task.velocity_des()[row] - last.rate[row] : 0.0;
    together = std::hypot(together, change[row] / task.speed_share(row));
  }
  for (Index row = 0; row < task.rows(); ++row) {
    if (change[row] == 0.0) continue;
    const double size = task.rows_apart() ? std::abs(change[row]) : together;
    last.rate[row] += change[row] * std::min(1.0, allowed / size);
    lower[row] = upper[row] = task.velocity_des()[row] + last.rate[row];
  }
}

void RateChanges::save(StateWriter& writer) const {
  for (const std::vector<Asked>& level : last_) {
    for (const Asked& asked : level) {
      writer.put(asked.rate);
      writer.put(asked.known ? 1.0 : 0.0);
    }
  }
}

void RateChanges::restore(StateReader& reader) {
  for (std::vector<Asked>& level : last_) {
    for (Asked& asked : level) {
      reader.get(asked.rate);
      asked.known = reader.get_count(1) > 0;
    }
  }
}

}  // namespace hurcules
