// What watches over a run: limits, and whether the robot still stands.
#pragma once

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/telemetry.hpp"

namespace hurcules {

// Worst excess over any limit so far, 0 for none.
struct Excess {
  double position = 0.0;  // [rad]
  double velocity = 0.0;  // [rad/s]
  double torque = 0.0;    // [N m]
};

class LimitWatch {
 public:
  // the velocity limits of the coordinates and the torque limits of the joints, inf for none
  LimitWatch(const Robot& robot, Vector max_torque);
  void look(const Telemetry& telemetry);
  void reset();
  [[nodiscard]] const Excess& measured() const { return measured_; }  // in the physics
  [[nodiscard]] const Excess& commanded() const {
    return commanded_;
  }  // in the references, before saturation
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  Vector max_velocity_, max_torque_;
  Excess measured_, commanded_;
};

// The robot fell when its pelvis is too low above the support, or the support tilted too far.
class FallWatch {
 public:
  struct Limits {
    double min_height = 0.0;  // [m] pelvis above support
    double max_tilt = 0.0;    // [rad] of the support against its start
  };
  explicit FallWatch(Limits limits) : limits_(limits) {}
  void reset(const Matrix3& R_support);  // R_WS at the start
  [[nodiscard]] bool fell(const Matrix3& R_support, double height) const;
  [[nodiscard]] double tilt(const Matrix3& R_support) const;  // [rad]
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  Limits limits_;
  Vector3 up_ = Vector3::UnitZ();  // the world's z in the support, at the start
};

}  // namespace hurcules
