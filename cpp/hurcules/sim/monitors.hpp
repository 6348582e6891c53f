// What runs beside the controller and sees trouble come [T §4.2.1]: self-collision, tipping over,
// hot motors, power. It only looks: it commands nothing.
//
// Each tick, after the step, of the state at the beginning of the tick. What it stands on:
// support.hpp. In the air the measures of standing keep their last values; a robot whose root is
// not free (fixed to the world, on a rail) cannot tip over: they are NaN.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/sim/motor_thermal_model.hpp"
#include "hurcules/sim/recorder.hpp"
#include "hurcules/sim/self_distance.hpp"
#include "hurcules/sim/support.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

// An alarm is raised beyond its threshold, and falls when the value has been back by a tenth of it
// for half a second.
// An infinite threshold never alarms.
struct MonitorOptions {
  bool on = true;
  SelfDistanceOptions distance;
  MotorThermalOptions windings;
  double min_distance = 0.01;        // [m] self-collision; the acquisition posture has 0.02
  double min_margin = 0.05;          // [m] static margin; 0.06 is kept in [robot#postures]
  double min_pressure_margin = 0.0;  // [m] below zero it is never: off
  double min_tip_angle = 0.05;       // [rad]
  double min_energy = 0.0;           // [J] off while it stands
  double max_temperature = 120.0;    // [deg C] of the hottest motor
  double max_power = 20e3;           // [W] from the battery
};

class Monitors {
 public:
  enum Quantity : Index { Distance, Margin, PressureMargin, TipAngle, Energy, Temperature, Power };
  static constexpr Index kQuantities = 7;
  // with their units: "self_collision_distance_m", ...
  [[nodiscard]] static const std::vector<std::string>& names();
  // smaller is worse for this one, else larger
  [[nodiscard]] static bool falls(Index quantity) { return quantity <= Energy; }

  // dt [s] from one look to the next; throws Error for options out of range
  Monitors(const mjModel_* model, const std::vector<int>& robot_roots, const MotorLosses& losses,
           double dt, const MonitorOptions& options = {});
  // null: nothing is known until the first look
  void reset(const mjModel_* model = nullptr, mjData_* data = nullptr);
  // power [W] of this tick
  void look(const mjModel_* model, mjData_* data, double power);

  [[nodiscard]] const MonitorOptions& options() const { return options_; }
  [[nodiscard]] double value(Index quantity) const { return value_[quantity]; }
  // the worst since the reset, NaN before the first tick
  [[nodiscard]] double worst(Index quantity) const { return worst_[quantity]; }
  [[nodiscard]] bool alarm(Index quantity) const { return alarm_[quantity] > 0.0; }
  [[nodiscard]] double threshold(Index quantity) const { return threshold_[quantity]; }
  [[nodiscard]] const SelfDistance& self_distance() const { return distance_; }
  [[nodiscard]] const MotorThermalModel& windings() const { return windings_; }
  [[nodiscard]] Index support_points() const { return support_.points(); }  // of the last tick
  void add_log_channels(Recorder& recorder) const;                          // monitor/NAME
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void look_at_stand(const mjModel_* model, mjData_* data);
  void note(Index quantity, double value);
  [[nodiscard]] Vector thresholds() const;

  MonitorOptions options_;
  bool stands_;  // its root is free
  SelfDistance distance_;
  Support support_;
  MotorThermalModel windings_;
  double dt_;
  Vector threshold_, value_, worst_;  // (kQuantities)
  Vector alarm_;                      // [s] it still lasts
};

}  // namespace hurcules
