// Joints that are moved one by one, while no stack rules: within an acceleration, the speed of their
// motors, and a way to brake before the end of their ranges, which they pass in no case.
#pragma once

#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/control/joint_servo.hpp"
#include "hurcules/control/rate_interval.hpp"

namespace hurcules {

class JointMotion {
 public:
  // dt, horizon and acceleration of `limits` [rad/s^2]; the speeds are those of the motors
  JointMotion(const JointServo& servo, const RateLimits& limits);

  // a stack no longer rules: what it left in motion stops, until somebody moves it
  void begin(const JointServo& servo);
  void leave(Index joint) { stops_[static_cast<std::size_t>(joint)] = false; }  // to who moves it
  void leave_all() { stops_.assign(stops_.size(), false); }
  // one period of a joint at this velocity [rad/s]
  void lead(Index joint, double velocity, JointServo& servo) const {
    lead(joint, velocity, limits_.max_acceleration, servo);
  }
  // one period of all that are to stop
  void stop(JointServo& servo);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void lead(Index joint, double velocity, double acceleration, JointServo& servo) const;

  RateLimits limits_;
  std::vector<bool> stops_;  // (joints of the servo)
};

}  // namespace hurcules
