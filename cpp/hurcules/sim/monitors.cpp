#include "hurcules/sim/monitors.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool is_free(const mjModel* m, int body) {
  return m->body_jntnum[body] > 0 && m->jnt_type[m->body_jntadr[body]] == mjJNT_FREE;
}

bool is_worse(Index quantity, double value, double than) {
  return Monitors::falls(quantity) ? value < than : value > than;
}

}  // namespace

const std::vector<std::string>& Monitors::names() {
  static const std::vector<std::string> names = {"self_collision_distance_m",
                                                 "static_margin_m",
                                                 "pressure_margin_m",
                                                 "tip_angle_rad",
                                                 "energy_margin_J",
                                                 "motor_temperature_C",
                                                 "power_W"};
  return names;
}

Monitors::Monitors(const mjModel_* m, const std::vector<int>& robot_roots,
                   const MotorLosses& losses, double dt, const MonitorOptions& options)
    : options_(options),
      stands_(is_free(m, robot_roots.front())),
      distance_(m, robot_roots, options.distance),
      support_(m, robot_roots.front()),
      windings_(m, losses, dt, options.windings),
      dt_(dt),
      threshold_(thresholds()),
      alarm_(Vector::Zero(kQuantities)) {
  for (Index i = 0; i < kQuantities; ++i) {
    require(!std::isnan(threshold_[i]), "monitors: the threshold of " +
                                            names()[static_cast<std::size_t>(i)] +
                                            " wants a number, NaN came");
  }
  reset();
}

Vector Monitors::thresholds() const {
  Vector result(kQuantities);
  result << options_.min_distance, options_.min_margin, options_.min_pressure_margin,
      options_.min_tip_angle, options_.min_energy, options_.max_temperature, options_.max_power;
  return result;
}

void Monitors::reset(const mjModel_* m, mjData_* d) {
  windings_.reset();
  value_ = Vector::Zero(kQuantities);
  if (!stands_) value_.segment(Margin, Energy - Margin + 1).setConstant(kNone);
  value_[Distance] = options_.distance.cutoff;
  value_[Temperature] = options_.windings.ambient;
  worst_ = Vector::Constant(kQuantities, kNone);
  if (options_.on && d) look_at_stand(m, d);
  distance_.reset();
  worst_.setConstant(kNone);
  alarm_.setZero();
}

void Monitors::look(const mjModel_* m, mjData_* d, double power) {
  if (!options_.on) return;
  look_at_stand(m, d);
  windings_.warm(d);
  note(Temperature, windings_.temperature().size() > 0 ? windings_.temperature().maxCoeff()
                                                       : options_.windings.ambient);
  note(Power, power);
}

void Monitors::look_at_stand(const mjModel_* m, mjData_* d) {
  note(Distance, distance_.measure(m, d));
  if (!stands_) return;
  if (const std::optional<Stability> stands = support_.measure(m, d)) {
    note(Margin, stands->margin);
    note(PressureMargin, stands->pressure_margin);
    note(TipAngle, stands->tip_angle);
    note(Energy, stands->energy);
  }
}

void Monitors::note(Index quantity, double value) {
  value_[quantity] = value;
  if (std::isnan(worst_[quantity]) || is_worse(quantity, value, worst_[quantity])) {
    worst_[quantity] = value;
  }
  constexpr double kLasts = 0.5;  // [s] after the last trouble: an alarm does not chatter
  const double limit = threshold_[quantity];
  const double back =
      falls(quantity) ? limit + 0.1 * std::abs(limit) : limit - 0.1 * std::abs(limit);
  if (is_worse(quantity, value, limit)) {
    alarm_[quantity] = kLasts;
  } else if (is_worse(quantity, value, back)) {
    if (alarm_[quantity] > 0.0) alarm_[quantity] = kLasts;
  } else {
    alarm_[quantity] = std::max(0.0, alarm_[quantity] - dt_);
  }
}

void Monitors::add_log_channels(Recorder& recorder) const {
  recorder.add("monitor", names(), value_);
}

void Monitors::save(StateWriter& writer) const {
  distance_.save(writer);
  windings_.save(writer);
  for (const Vector* values : {&value_, &worst_, &alarm_}) writer.put(*values);
}

void Monitors::restore(StateReader& reader) {
  distance_.restore(reader);
  windings_.restore(reader);
  // NaN of a robot that does not stand, and before the first tick
  for (Vector* values : {&value_, &worst_}) {
    for (double& value : *values) value = reader.get_any();
  }
  reader.get(alarm_);
}

}  // namespace hurcules
