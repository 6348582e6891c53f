// Everything that a tick leaves behind for log, observation and figures: plain numbers at fixed
// addresses.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/sim/recorder.hpp"

namespace hurcules {

// The names along the vectors below.
struct TelemetryNames {
  std::vector<std::string> coordinates;  // (n)
  std::vector<std::string> joints;       // (m) of the servo
  std::vector<std::string> levels;       // (p)
  std::vector<std::string> task_rows;    // (r) "lhpos/0", all tasks of all levels but the limits
  std::vector<std::string> commands;     // (k)
  std::vector<std::string> forces;       // (f) of the force tasks
};

struct Telemetry {
  explicit Telemetry(const TelemetryNames& names);
  // recorders know the addresses of the numbers: they stay
  Telemetry(const Telemetry&) = delete;
  Telemetry& operator=(const Telemetry&) = delete;
  void clear();

  double time = 0.0;       // [s] since reset
  double phase = 0.0;      // number of the phase
  Vector q, qd;            // [rad], [rad/s] (n) measured in the physics
  Vector seen_q, seen_qd;  // (n) as the sensors say
  Vector q_des, qd_des;    // (n) commanded
  Vector lag;              // [rad] (n) commanded minus seen
  Vector limit_lower,
      limit_upper;              // [rad] (n) of the present mode, of the joints where no stack rules
  Vector limit_speed;           // [rad/s] (n) the same
  Vector to_lower, to_upper;    // [rad] (n) seen distance to them, negative beyond
  Vector active;                // (n) -1 0 1: held back by a position limit
  Vector torque, demand;        // [N m] (m) applied, and asked for
  Vector joint_error;           // [rad] (m)
  double tracking_error = 0.0;  // [rad] largest of them, of the joints of coordinates
  Vector level_error, level_error_measured;  // (p) norms, in the unit of the tasks
  Vector level_active;                       // (p) rows of any level that this one pushes against
  Vector task_error, task_error_measured;    // (r)
  Vector command;                            // [m/s] or [rad/s] (k)
  Vector force, contact;                     // [N] read; number of the ContactState (f)
  Vector base_position, base_rotation;       // [m], rotation vector [rad] (3) of the support in W
  Vector seen_base_position, seen_base_rotation;  // the same as the sensors say
  Vector base_velocity, base_spin;                // [m/s], [rad/s] (3) as the sensors say
  Vector target_in_base;  // [m] (3) the casualty, seen from the support; zero without one
  double factorizations = 0.0, changes = 0.0, iterations = 0.0, status = 0.0, optimality = 0.0;
  double power = 0.0, charge = 0.0;  // [W] from the battery; what is left in it, 0 to 1
  double yielding = 0.0;             // 1 while the reference yields to what the motors cannot bear
  double link_age = 0.0;             // [s] since the operator's link was heard; 0: never
  double tick_us = 0.0;              // [us] sense to servo; 0 without a clock

  // what the log holds; tick_us only with a clock
  void add_log_channels(const TelemetryNames& names, Recorder& recorder) const;
  // what a policy sees
  void add_observation_channels(const TelemetryNames& names, Recorder& recorder) const;
};

}  // namespace hurcules
