#include "hurcules/control/yielding_targets.hpp"

#include <algorithm>

namespace hurcules {

namespace {

// [s] after which a target begins to come back, and after which it does so at its full rate
constexpr double kWait = 0.5, kFullRate = 1.0;
constexpr double kReturnRate = 4.0;    // [1/s]
constexpr double kLeastReturn = 1e-3;  // [unit/s]
constexpr double kReturned = 1e-12;    // [unit]

}  // namespace

YieldingTargets::YieldingTargets(const std::vector<Task*>& tasks) {
  for (Task* const task : tasks) {
    const Vector none = Vector::Zero(task->yielding_target().size());
    yielded_.push_back({task, false, none, none, none});
  }
  forget();
}

void YieldingTargets::forget() {
  for (Yielded& yielded : yielded_) {
    yielded.on = false;
    yielded.wanted.setZero();
    yielded.left.setZero();
  }
  free_ = kFullRate;
}

void YieldingTargets::update(bool slowed, double rate, double dt) {
  free_ = slowed ? 0.0 : std::min(free_ + dt, kFullRate);
  for (Yielded& yielded : yielded_) {
    yielded.on = yielded.on && yielded.task->yielding_target() == yielded.left;
    if (slowed) {
      yielded.give_way(rate * dt, dt);
    } else if (yielded.on) {
      yielded.lead_back(free_, dt);
    }
    if (yielded.on) yielded.left = yielded.task->yielding_target();
  }
}

void YieldingTargets::Yielded::give_way(double share, double dt) {
  const bool rests = task->velocity_des().isZero(0.0);
  if (on && !rests) stop(dt);
  if (!on && rests && wanted.size() > 0) {
    wanted = task->yielding_target();
    on = true;
  }
  task->back_calculate(share);
}

// a step of the way to where it rested
void YieldingTargets::Yielded::lead_back(double free, double dt) {
  step = wanted - left;
  const double length = step.norm();
  if (length <= kReturned) {
    on = false;
    return stop(dt);
  }
  const double ramp = std::max(0.0, free - kWait) / (kFullRate - kWait);
  const double rate = std::min(kReturnRate * length + kLeastReturn, task->max_speed());
  step *= std::min(1.0, ramp * rate * dt / length);
  task->lead_target(step, dt);
}

void YieldingTargets::Yielded::stop(double dt) {
  if (task->velocity_des().isZero(0.0)) return;
  step.setZero();
  task->lead_target(step, dt);
}

double YieldingTargets::given_way(const Task& task) const {
  for (const Yielded& yielded : yielded_) {
    if (yielded.task == &task && yielded.on) return (yielded.wanted - yielded.left).norm();
  }
  return 0.0;
}

void YieldingTargets::save(StateWriter& writer) const {
  writer.put(free_);
  for (const Yielded& yielded : yielded_) {
    writer.put(yielded.on ? 1.0 : 0.0);
    writer.put(yielded.wanted);
    writer.put(yielded.left);
  }
}

void YieldingTargets::restore(StateReader& reader) {
  free_ = reader.get();
  for (Yielded& yielded : yielded_) {
    yielded.on = reader.get_count(1) > 0;
    reader.get(yielded.wanted);
    reader.get(yielded.left);
  }
}

}  // namespace hurcules
