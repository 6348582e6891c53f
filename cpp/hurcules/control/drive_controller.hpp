// Drives a vehicle on two tracks: forward speed and yaw rate, or a pose to park at, to the torques
// of the left and right drive, and the brakes when it stands.
//
//   command -> profiles with limited acceleration and jerk -> v, omega
//   v_c = v + k_v (v - v_ground)
//   omega_c = omega + k (omega - omega_gyro) + b,   db/dt = k_b (omega - omega_gyro)
//   belt references: v_c -+ omega_c B / 2, either part within the slip limit of what is measured; the
//   ground passes under the belts' middle at v_ground or, where the outer track holds it, more slowly
//   torque = gain (w_ref - w) + integral + mass r a / 2
//
// Where a drive has no more torque or power, both drives give up the same: the difference, which
// turns, stays, and the speed falls. Where neither has the power for the turn at this speed, the one
// that drives gives up what they lack, and the speed falls until they have it.
//
// Skid steering turns less than its belts ask for: the belts' difference over the yaw rate is an
// effective gauge B, larger than the real one, which the gyro tells while the robot turns.
// Knows no physics engine: what it measures comes in, what the drives give goes out.
#pragma once

#include "hurcules/base/state.hpp"
#include "hurcules/control/parking.hpp"
#include "hurcules/control/speed_profile.hpp"

namespace hurcules {

struct DriveOptions {
  double dt = 1e-3;                   // [s] control period
  double radius = 0.14;               // [m] belt speed over belt rate
  double gauge = 0.67;                // [m] between the middles of the driven tracks
  double mass = 680.0;                // [kg] for the feed-forward of acceleration; 0 for none
  double max_torque = 600.0;          // [N m] of one drive
  double max_power = 7950.0;          // [W] of one drive, driving
  double max_braking_power = 1e6;     // [W] of one drive; a transmission passes on less
  double max_speed = 5.56;            // [m/s] of a belt, 20 km/h
  double max_yaw_rate = 1.5;          // [rad/s]
  double max_sideways = 2.5;          // [m/s^2] speed times yaw rate
  SpeedLimits forward = {2.0, 8.0};   // [m/s^2], [m/s^3]
  SpeedLimits turning = {2.0, 10.0};  // [rad/s^2], [rad/s^3]
  double gain = 300.0;                // [N m s/rad]
  double integral_gain = 900.0;       // [N m/rad]
  double speed_gain = 1.0;            // share of a speed error that the belts are asked for
  double yaw_gain = 1.0;              // k
  double yaw_integral_gain = 2.0;     // [1/s] k_b
  double slip_speed = 0.2;            // [m/s] by which a belt may slip
  double slip_ratio = 0.1;            // and this share of the ground speed on top
  double standstill_time = 0.2;       // [s] without motion before the brakes close
  double brake_time = 0.1;            // [s] the drives go on holding until they are shut
  ParkingOptions parking = {};
};

// What is measured.
struct DriveState {
  double left = 0.0, right = 0.0;  // [rad/s] of the driven belts, > 0 forward
  double yaw_rate = 0.0;           // [rad/s] gyro about the vertical, > 0 to the left
  double speed = 0.0;              // [m/s] along the ground, up and down slopes too, by heading
  PlanarPose pose;                 // used while parking only
};

struct DriveTorques {
  double left = 0.0, right = 0.0;  // [N m]
  bool brake = false;              // of both drives, to be shut
};

class DriveController {
 public:
  // throws Error for options out of range
  explicit DriveController(const DriveOptions& options = {});
  // from now on; beyond the limits of speed and yaw rate it is held at them. Throws Error for
  // numbers that are not finite.
  void drive(const DriveCommand& command);
  // goes to this pose and stays there, brakes shut; see parking.hpp
  void park(const PlanarPose& goal);
  // one control period; a measurement that is not finite shuts the brakes and changes nothing else
  DriveTorques compute(const DriveState& measured);

  [[nodiscard]] bool braked() const { return braked_; }
  [[nodiscard]] ParkingPhase parking_phase() const { return parking_.phase(); }
  [[nodiscard]] double gauge() const { return gauge_; }  // [m] effective, as estimated
  // a belt was held back in the last tick
  [[nodiscard]] bool slipping() const { return driving_slips_ || turning_slips_; }
  // what the profiles ask for at this moment [m/s, rad/s]
  [[nodiscard]] DriveCommand reference() const { return {speed_.speed(), yaw_rate_.speed()}; }
  [[nodiscard]] const DriveOptions& options() const { return options_; }
  void reset();  // stands, braked, knows nothing of the ground
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  [[nodiscard]] DriveCommand wanted(const DriveState& measured);
  [[nodiscard]] DriveCommand within_limits(DriveCommand command) const;
  void mind_brakes(const DriveState& measured, const DriveCommand& command);
  void learn_gauge(const DriveState& measured);
  [[nodiscard]] double drive_at(const DriveState& measured) const;
  double steer(const DriveState& measured);
  [[nodiscard]] double within_slip(double reference, double one, double other) const;
  // one drive in one tick: what it is to give [N m], what it can, and what led there
  struct Belt {
    double demand = 0.0, lower = 0.0, upper = 0.0;
    double change = 0.0;  // [N m] of the integral in this tick
  };
  [[nodiscard]] Belt belt(double reference, double rate, double integral) const;
  void slow_down(const DriveState& measured, Belt& left, Belt& right) const;
  void integrate(const Belt& left, const Belt& right, const DriveTorques& given);
  DriveTorques hold();

  DriveOptions options_;
  Parking parking_;
  SpeedProfile speed_, yaw_rate_;
  DriveCommand command_;
  double left_integral_ = 0.0, right_integral_ = 0.0;  // [N m]
  double yaw_integral_ = 0.0;                          // [rad/s]
  double gauge_ = 0.0;                                 // [m]
  double still_ = 0.0;                                 // [s] without motion, or behind brakes
  bool braked_ = true, driving_slips_ = false, turning_slips_ = false;
};

}  // namespace hurcules
