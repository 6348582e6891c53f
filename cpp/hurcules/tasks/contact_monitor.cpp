#include "hurcules/tasks/contact_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

constexpr double kCoarse = 1e-3;   // of f_min: steps of a sensor, not of its noise
constexpr double kChanges = 20.0;  // before that its steps are not known

}  // namespace

std::string to_string(ContactState state) {
  switch (state) {
    case ContactState::Free:
      return "free";
    case ContactState::Contact:
      return "contact";
    case ContactState::Stopped:
      return "stopped: force above f_max";
    case ContactState::SensorLost:
      return "stopped: no force reading";
  }
  return "";
}

ContactMonitor::ContactMonitor(const ContactOptions& options, const std::string& task)
    : options_(options) {
  const std::string of = " of force task '" + task + "' ";
  require_number(std::isfinite(options.f_min) && options.f_min > 0.0,
                 "f_min" + of + "wants a positive number [N]", options.f_min);
  require_number(options.f_max > options.f_min, "f_max" + of + "wants to be above f_min [N]",
                 options.f_max);
  require(options.release_time >= 0.0 && options.patience >= 0.0 && options.frozen_move >= 0.0,
          "release_time, patience and frozen_move" + of + "want numbers >= 0");
  require_number(std::isfinite(options.dt) && options.dt > 0.0,
                 "dt" + of + "wants a positive time [s]", options.dt);
  release_ = 0.5 * options.f_min;
}

void ContactMonitor::expect(double force_des) {
  const double size = std::abs(force_des);
  release_ = 0.5 * (size > 0.0 ? std::min(size, options_.f_min) : options_.f_min);
}

void ContactMonitor::learn_step(double reading) {
  const double change = std::abs(reading - force_);
  if (change == 0.0) return;
  if (step_ == 0.0 || change < step_) step_ = change;
  changes_ += 1.0;
  const double steps = reading / step_;
  coarse_ = changes_ >= kChanges && step_ > kCoarse * options_.f_min &&
            std::abs(steps - std::round(steps)) < 1e-6;
}

ContactState ContactMonitor::look(double reading, double position) {
  if (state_ == ContactState::SensorLost) return state_;
  const double dt = options_.dt;
  if (!std::isfinite(reading)) {
    missing_ += dt;
    if (missing_ > options_.patience) state_ = ContactState::SensorLost;
    return state_;
  }
  missing_ = 0.0;
  if (reading != force_) changed_at_ = position;
  learn_step(reading);
  force_ = reading;
  const double size = std::abs(reading);
  if (size > options_.f_max) return state_ = ContactState::Stopped;
  if (state_ == ContactState::Free) {
    quiet_ = 0.0;
    if (size >= options_.f_min) state_ = ContactState::Contact;  // [T 5.7.64]
    return state_;
  }
  const double moved = std::abs(position - changed_at_);
  const bool pressed = size >= release_;
  if (pressed && !coarse_ && options_.frozen_move > 0.0 && moved > options_.frozen_move)
    return state_ = ContactState::SensorLost;
  if (state_ == ContactState::Stopped) return state_;
  quiet_ = size < release_ ? quiet_ + dt : 0.0;
  if (quiet_ > options_.release_time) state_ = ContactState::Free;
  return state_;
}

void ContactMonitor::reset() {
  state_ = ContactState::Free;
  force_ = quiet_ = missing_ = changed_at_ = step_ = changes_ = 0.0;
  coarse_ = false;
}

void ContactMonitor::save(StateWriter& writer) const {
  for (const double value :
       {static_cast<double>(static_cast<int>(state_)), force_, quiet_, missing_, changed_at_,
        release_, step_, changes_, coarse_ ? 1.0 : 0.0}) {
    writer.put(value);
  }
}

void ContactMonitor::restore(StateReader& reader) {
  state_ = static_cast<ContactState>(reader.get_count(3));
  for (double* value : {&force_, &quiet_, &missing_, &changed_at_, &release_, &step_, &changes_})
    *value = reader.get();
  coarse_ = reader.get_count(1) > 0;
}

}  // namespace hurcules
