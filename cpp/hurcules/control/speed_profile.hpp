// A speed that follows its target with bounded acceleration and jerk, sample by sample.
//
// The acceleration aims at sqrt(2 jerk |target - speed|): from there the jerk limit alone brings it
// to zero just when the target is reached, so that nothing overshoots and no stop jolts.
#pragma once

#include "hurcules/base/state.hpp"

namespace hurcules {

struct SpeedLimits {
  double acceleration = 1.0;  // [m/s^2] or [rad/s^2], > 0
  double jerk = 5.0;          // [m/s^3] or [rad/s^3], > 0
};

class SpeedProfile {
 public:
  // dt [s] between two samples; throws Error for a number that is not above 0
  SpeedProfile(const SpeedLimits& limits, double dt);
  // the next sample on the way to the target [m/s] or [rad/s], which may change at any time
  double advance(double target);
  void reset(double speed = 0.0);

  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] double acceleration() const { return acceleration_; }
  [[nodiscard]] bool at_rest() const { return speed_ == 0.0 && acceleration_ == 0.0; }
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  SpeedLimits limits_;
  double dt_;
  double speed_ = 0.0, acceleration_ = 0.0;
};

}  // namespace hurcules
