#include "hurcules/control/rate_changes.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

constexpr double kLead = 0.2;  // [s]

}  // namespace

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
  change_ = goes_ = Vector::Zero(most);
}

void RateChanges::forget() {
  for (std::vector<Asked>& level : last_)
    for (Asked& asked : level) asked.known = false;
}

void RateChanges::limit(std::size_t k, std::size_t i, const Task& task, const Vector& velocity,
                        double dt, VectorRef lower, VectorRef upper) {
  Asked& last = last_[k][i];
  const double a = task.max_acceleration();
  if (std::isinf(a)) {
    last.known = false;
    return;
  }
  auto goes = goes_.head(task.rows()), change = change_.head(task.rows());
  goes.noalias() = task.jacobian().leftCols(velocity.size()) * velocity;
  goes -= task.velocity_des();
  double together = 0.0;
  for (Index row = 0; row < task.rows(); ++row) {
    const double least = lower[row] - task.velocity_des()[row];
    const double most = upper[row] - task.velocity_des()[row];
    const double lead = kLead * a * task.speed_share(row);
    const bool asks = task.weights()[row] > 0.0;
    const bool pushes = asks && (least == most || least > 0.0 || most < 0.0);
    double& rate = last.rate[row];
    const bool knows = last.known && std::isfinite(rate);
    rate = knows && pushes ? std::clamp(rate, goes[row] - lead, goes[row] + lead) : goes[row];
    change[row] = asks ? std::clamp(rate, least, most) - rate : 0.0;
    together = std::hypot(together, change[row] / task.speed_share(row));
  }
  last.known = true;
  for (Index row = 0; row < task.rows(); ++row) {
    if (change[row] == 0.0) continue;
    const double size = task.rows_apart() ? std::abs(change[row]) : together;
    last.rate[row] += change[row] * std::min(1.0, a * dt / size);
    const double rate = task.velocity_des()[row] + last.rate[row];
    const bool point = lower[row] == upper[row];
    if (point || change[row] > 0.0) lower[row] = rate;
    if (point || change[row] < 0.0) upper[row] = rate;
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
