// How far a run went over the limits of coordinates and joints.
#pragma once

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/telemetry.hpp"

namespace hurcules {

// Worst excess over any limit, 0 for none.
struct Excess {
  double position = 0.0;  // [rad]
  double velocity = 0.0;  // [rad/s]
  double torque = 0.0;    // [N m]
};

class LimitMonitor {
 public:
  // the velocity limits of the coordinates and the torque limits of the joints, inf for none
  LimitMonitor(const Robot& robot, Vector max_torque);
  void look(const Telemetry& telemetry);
  void reset();
  // in the physics, so far and in the last period
  [[nodiscard]] const Excess& measured() const { return measured_; }
  [[nodiscard]] const Excess& now() const { return now_; }
  [[nodiscard]] const Excess& commanded() const {
    return commanded_;
  }  // in the references, before saturation
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  Vector max_velocity_, max_torque_;
  Excess measured_, now_, commanded_;
};

}  // namespace hurcules
