#include "hurcules/control/speed_profile.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/base/values.hpp"

namespace hurcules {

SpeedProfile::SpeedProfile(const SpeedLimits& limits, double dt) : limits_(limits), dt_(dt) {
  require_number(std::isfinite(dt) && dt > 0.0, "dt wants a positive time [s]", dt);
  require_number(std::isfinite(limits.acceleration) && limits.acceleration > 0.0,
                 "a speed profile wants a positive acceleration", limits.acceleration);
  require_number(std::isfinite(limits.jerk) && limits.jerk > 0.0,
                 "a speed profile wants a positive jerk", limits.jerk);
}

double SpeedProfile::advance(double target) {
  const double error = target - speed_;
  const double step = limits_.jerk * dt_;
  // a falls by `step` a sample: the speed it still adds is a (a + step) / (2 jerk)
  const double end =
      std::sqrt(step * step / 4.0 + 2.0 * limits_.jerk * std::abs(error)) - step / 2.0;
  const double wanted = std::copysign(std::min(end, limits_.acceleration), error);
  acceleration_ += std::clamp(wanted - acceleration_, -step, step);
  const double next = speed_ + acceleration_ * dt_;
  const bool arrives = (target - next) * error <= 0.0 && std::abs(acceleration_) <= step;
  speed_ = arrives ? target : next;
  if (arrives) acceleration_ = 0.0;
  return speed_;
}

void SpeedProfile::reset(double speed) {
  speed_ = speed;
  acceleration_ = 0.0;
}

void SpeedProfile::save(StateWriter& writer) const {
  writer.put(speed_);
  writer.put(acceleration_);
}

void SpeedProfile::restore(StateReader& reader) {
  speed_ = reader.get();
  acceleration_ = reader.get();
}

}  // namespace hurcules
