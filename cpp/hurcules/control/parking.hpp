// Parks a vehicle that can turn in place: which speed and yaw rate lead to a pose on the plane.
//
//   Face      turn in place towards (or away from) the place `run_in` behind the goal
//   Approach  drive there on a straight line, forward or in reverse
//   Align     turn in place to the goal's heading
//   RunIn     drive the last `run_in` along the goal's own line; end on it
//
// A line is kept by steering at heading - sign(v) atan(line_gain e), e the offset to its left. The
// run-in takes out what the turns, which slip sideways, have left. An end outside the tolerances
// goes back in reverse and runs in again. All places are those of the turning centre: of all
// points of a skid-steered robot it alone does not move sideways.
#pragma once

#include "hurcules/base/state.hpp"

namespace hurcules {

struct PlanarPose {
  double x = 0.0, y = 0.0;  // [m]
  double yaw = 0.0;         // [rad] of the forward axis from x towards y
};

struct DriveCommand {
  double speed = 0.0;     // [m/s] forward
  double yaw_rate = 0.0;  // [rad/s] to the left
};

struct ParkingOptions {
  double speed = 0.5;          // [m/s] at most
  double yaw_rate = 0.5;       // [rad/s] at most, turning in place
  double deceleration = 0.25;  // [m/s^2] towards the end of a line
  double turn_centre = -0.40;  // [m] forward of the pose's origin: where turns in place are about
  double run_in = 1.0;         // [m]
  double line_gain = 2.5;      // [rad/m] heading against an offset
  double heading_gain = 2.0;   // [1/s] yaw rate against a heading error
  double max_offset = 0.02;    // [m] of the turning centre at the end
  double max_turn = 0.02;      // [rad] of the heading at the end
  int attempts = 4;            // run-ins at most
  double patience = 3.0;       // times what a turn or a line takes at full speed, and 5 s on top
};

enum class ParkingPhase { Off, Face, Approach, Align, RunIn, Done, Failed };

class Parking {
 public:
  // dt [s] between two commands; throws Error for options that are not above 0 (the turning centre
  // may be anything finite)
  Parking(const ParkingOptions& options, double dt);
  // goes to this pose from now on; throws Error for numbers that are not finite
  void start(const PlanarPose& goal);
  void stop() { phase_ = ParkingPhase::Off; }
  // what leads there from the measured pose; `stopped`: the last command was zero and is reached
  DriveCommand command(const PlanarPose& measured, bool stopped);

  [[nodiscard]] ParkingPhase phase() const { return phase_; }
  [[nodiscard]] bool under_way() const;
  [[nodiscard]] const PlanarPose& goal() const { return goal_; }
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Line {
    double x = 0.0, y = 0.0, yaw = 0.0;  // where it ends, and the heading of the robot on it
    double direction = 1.0;              // 1 forward, -1 in reverse
  };
  void begin(ParkingPhase phase);
  // whether this turn or line, which takes `seconds` at full speed, has lasted for too long
  [[nodiscard]] bool lost_patience(double seconds);
  void aim(const PlanarPose& centre);
  void end_run_in(const PlanarPose& centre);
  [[nodiscard]] PlanarPose centre_of(const PlanarPose& pose) const;
  [[nodiscard]] DriveCommand turn(double error) const;
  [[nodiscard]] double remaining(const PlanarPose& centre) const;
  [[nodiscard]] DriveCommand follow(const PlanarPose& centre) const;

  ParkingOptions options_;
  double dt_;
  ParkingPhase phase_ = ParkingPhase::Off;
  PlanarPose goal_, goal_centre_;
  Line line_;
  int attempts_ = 0;
  double left_ = -1.0;    // [s] of patience with this phase, < 0: it has not begun
  bool turning_ = false;  // a turn in place has begun
  bool ending_ = false;   // the phase only waits for the robot to stop
};

}  // namespace hurcules
