// The doc texts of bind_sensors.cpp.
#pragma once

namespace hurcules_bindings {

inline constexpr const char* kSensorModel =
    R"(How a sensor departs from the truth; all zero: not at all, to the last bit.

Args:
  noise: standard deviation of each sample, in the unit of the sensor.
  bias: standard deviation of a constant that is drawn at the start.
  drift: of a bias that walks, its standard deviation after 1 s.
  delay: samples, 0 to 1000.
  step: of the last bit; 0 is as fine as a double.
)";
inline constexpr const char* kRangeFinder =
    R"(A planar laser scanner in the x-y plane of a site; its mirror turns a few rays each tick.

Args:
  rays: of a scan; 0: there is no scanner.
  period: ticks a scan.
  angle: [rad] field of view about x of the site, at most 2 pi.
  min_range: [m] what is nearer reads 0.
  max_range: [m] what is further reads inf.
  model: SensorModel [m]; its delay in whole scans.
  site: of the model; its own body is not seen.
)";
inline constexpr const char* kRealisticSensors =
    "SensorOptions of typical sensors, with noise, bias, delay and resolution.";
inline constexpr const char* kFaultKind = "What is wrong with an entry of a sensor.";
inline constexpr const char* kSensorFault =
    R"(A fault of one entry of a sensor.

Args:
  entry: e.g. "encoder_position/LSP".
  kind: FaultKind.
  start: [s] from when on.
)";
inline constexpr const char* kSensorOptions =
    R"(The sensors of a simulation; hurcules.sensors.realistic() has typical ones.

Args:
  models: dict of sensor name to SensorModel; the others are ideal.
  range: RangeFinder.
  faults: list of SensorFault.
  hold_seconds: [s] that a robot which lost a joint's encoder is held before the run ends.
)";
inline constexpr const char* kMonitorOptions =
    R"(Thresholds of the monitors' alarms; an infinite one never alarms.

Args:
  on: whether they look at all.
  min_distance: [m] of the robot to itself.
  min_margin: [m] of the centre of mass to the edge of the support polygon.
  min_pressure_margin: [m] of the centre of pressure to that edge.
  min_tip_angle: [rad] to tip over about an edge.
  min_energy: [J] to tip over about an edge.
  max_temperature: [deg C] of the hottest motor.
  max_power: [W] from the battery.
)";
inline constexpr const char* kSensors =
    "What each sensor says now: dict of name to (m,); with a scanner also range (rays,) [m].";
inline constexpr const char* kSensorEntries =
    "What the numbers of each sensor are: dict of name to (unit, names of its entries).";
inline constexpr const char* kRayAngles =
    "(rays,) [rad] about z of the scanner's site, 0 along its x; empty without a scanner.";
inline constexpr const char* kMonitors =
    "What the monitors saw at the last tick: dict of name with unit to number.";
inline constexpr const char* kMotorTemperatures =
    "[deg C] of the motors' windings: dict of joint to number.";
inline constexpr const char* kSelfCollisionPairs =
    "(name, name) of the contact shapes whose distance is watched.";
inline constexpr const char* kNearestPair =
    "(name, name) of the nearest of these at the last tick; None beyond the cutoff of 0.25 m.";

}  // namespace hurcules_bindings
