#include "hurcules/sim/limit_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hurcules {

namespace {

// grows to the worst of `excess` and how far any value lies outside its sides
void outside(const Vector& value, const Vector& lower, const Vector& upper, double& excess) {
  for (Index i = 0; i < value.size(); ++i) {
    excess = std::max({excess, lower[i] - value[i], value[i] - upper[i]});
  }
}

void above(const Vector& value, const Vector& largest, double& excess) {
  for (Index i = 0; i < value.size(); ++i) {
    excess = std::max(excess, std::abs(value[i]) - largest[i]);
  }
}

}  // namespace

LimitMonitor::LimitMonitor(const Robot& robot, Vector max_torque)
    : max_velocity_(robot.size()), max_torque_(std::move(max_torque)) {
  for (Index i = 0; i < robot.size(); ++i) {
    max_velocity_[i] = robot.coordinates()[static_cast<std::size_t>(i)].max_velocity;
  }
}

void LimitMonitor::look(const Telemetry& t) {
  now_ = {};
  outside(t.q, t.limit_lower, t.limit_upper, now_.position);
  above(t.qd, max_velocity_, now_.velocity);
  above(t.torque, max_torque_, now_.torque);
  measured_ = {std::max(measured_.position, now_.position),
               std::max(measured_.velocity, now_.velocity),
               std::max(measured_.torque, now_.torque)};
  outside(t.q_des, t.limit_lower, t.limit_upper, commanded_.position);
  above(t.qd_des, max_velocity_, commanded_.velocity);
  above(t.demand, max_torque_, commanded_.torque);
}

void LimitMonitor::reset() {
  measured_ = now_ = commanded_ = Excess{};
}

void LimitMonitor::save(StateWriter& writer) const {
  for (const Excess& excess : {measured_, now_, commanded_}) {
    writer.put(excess.position);
    writer.put(excess.velocity);
    writer.put(excess.torque);
  }
}

void LimitMonitor::restore(StateReader& reader) {
  for (Excess* excess : {&measured_, &now_, &commanded_}) {
    excess->position = reader.get();
    excess->velocity = reader.get();
    excess->torque = reader.get();
  }
}

}  // namespace hurcules
