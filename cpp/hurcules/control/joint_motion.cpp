#include "hurcules/control/joint_motion.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

JointMotion::JointMotion(const JointServo& servo, const RateLimits& limits)
    : limits_(limits), stops_(static_cast<std::size_t>(servo.size()), false) {}

void JointMotion::begin(const JointServo& servo) {
  std::fill_n(stops_.begin(), servo.coordinate_joints(), true);
}

void JointMotion::lead(Index joint, double velocity, double acceleration, JointServo& servo) const {
  const JointActuator& actuator = servo.actuator(joint);
  const double from = servo.position()[joint], now = servo.velocity()[joint];
  RateLimits limits = limits_;
  limits.max_velocity = actuator.limits.speed;
  limits.max_acceleration = acceleration;
  const RateInterval within =
      rate_interval({actuator.lower - from, actuator.upper - from, now}, limits);
  const double most = acceleration * limits.dt;
  const double rate =
      std::clamp(std::clamp(velocity, within.lower, within.upper), now - most, now + most);
  const double place = from + rate * limits.dt;
  const double held = std::clamp(place, actuator.lower, actuator.upper);
  servo.move(joint, held, held == place ? rate : 0.0);
}

void JointMotion::stop(JointServo& servo) {
  for (Index joint = 0; joint < servo.coordinate_joints(); ++joint) {
    if (!stops_[static_cast<std::size_t>(joint)]) continue;
    if (servo.velocity()[joint] == 0.0) {
      leave(joint);
    } else {
      lead(joint, 0.0, std::abs(servo.factor(joint)) * limits_.max_acceleration, servo);
    }
  }
}

void JointMotion::save(StateWriter& writer) const {
  for (const bool stops : stops_) writer.put(stops ? 1.0 : 0.0);
}

void JointMotion::restore(StateReader& reader) {
  for (std::size_t i = 0; i < stops_.size(); ++i) stops_[i] = reader.get_count(1) > 0;
}

}  // namespace hurcules
