// control: the drive controller.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <optional>

#include "hurcules/base/error.hpp"
#include "hurcules/control/drive_controller.hpp"
#include "state.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_drive(py::module_& module);

namespace {

constexpr const char* kSpeedLimits = R"(How fast a commanded speed may change.

Args:
  acceleration: > 0, [m/s^2] or [rad/s^2].
  jerk: > 0, [m/s^3] or [rad/s^3].
)";
constexpr const char* kParkingOptions = R"(How a robot parks: turn, drive, turn, run in.

Args:
  speed: [m/s] at most.
  yaw_rate: [rad/s] at most, turning in place.
  deceleration: [m/s^2] towards the end of a line.
  turn_centre: [m] forward of the pose's origin: what turns in place are about.
  run_in: [m] driven along the goal's own line at the end.
  line_gain: [rad/m] heading against an offset from a line.
  heading_gain: [1/s] yaw rate against a heading error.
  max_offset: [m] of the turning centre at the end.
  max_turn: [rad] of the heading at the end.
  attempts: run-ins at most.
  patience: times what a turn or a line takes at full speed, and 5 s on top; then parking has failed.
)";
constexpr const char* kDriveOptions = R"(Options of the drive controller.

Args:
  dt: [s] control period.
  radius: [m] belt speed over belt rate.
  gauge: [m] between the middles of the driven tracks.
  mass: [kg] for the feed-forward of acceleration, 0 for none.
  max_torque: [N m] of one drive.
  max_power: [W] of one drive.
  max_speed: [m/s] of a belt.
  max_yaw_rate: [rad/s].
  max_sideways: [m/s^2] speed times yaw rate; who is to turn sharper slows down.
  forward: SpeedLimits [m/s^2, m/s^3].
  turning: SpeedLimits [rad/s^2, rad/s^3].
  gain: [N m s/rad] belt rate to torque.
  integral_gain: [N m/rad].
  speed_gain: share of a speed error that is added to what the belts are asked for.
  yaw_gain: share of a yaw rate error that is added to what the belts are asked for.
  yaw_integral_gain: [1/s].
  slip_speed: [m/s] by which a belt may slip.
  slip_ratio: share of the ground speed by which it may slip on top.
  standstill_time: [s] without motion before the brakes close.
  brake_time: [s] for which the drives hold on until the brakes are shut.
  parking: ParkingOptions.

Numbers out of range are refused by DriveController.
)";
constexpr const char* kPhase = "Where a parking robot is; Off: none was asked for.";
constexpr const char* kController =
    R"(Drives a robot on two tracks by speed and yaw rate, or to a pose.

Speeds follow their commands with limited acceleration and jerk; a belt that slips is held back; the
effective gauge of skid steering is learnt from the gyro. At standstill the brakes close.

Args:
  options: DriveOptions.

Raises:
  Error: an option out of range.
)";
constexpr const char* kDrive = R"(Drives like this from now on, ends parking.

Args:
  speed: [m/s] forward; beyond max_speed it is held there.
  yaw_rate: [rad/s] to the left; beyond max_yaw_rate it is held there.

Raises:
  Error: a number is not finite.
)";
constexpr const char* kPark = R"(Goes to this pose and stays there, brakes shut.

Args:
  x: [m] of the pose's origin in the world.
  y: [m].
  yaw: [rad] of the heading from x towards y.

Raises:
  Error: a number is not finite.
)";
constexpr const char* kCompute = R"(One control period.

Args:
  left: [rad/s] rate of the left driven belt, > 0 forward.
  right: [rad/s] of the right one.
  yaw_rate: [rad/s] of the gyro about the vertical, > 0 to the left.
  speed: [m/s] over ground along the heading.
  pose: (x, y, yaw) [m, m, rad]; wanted while the robot parks.

Returns:
  (left, right) torques of the drives [N m]; see also `braked`.

Raises:
  Error: a measurement is not finite, or the pose is missing.
)";
constexpr const char* kBraked = "whether the brakes of both drives are to be shut";

std::array<double, 2> compute(DriveController& self, double left, double right, double yaw_rate,
                              double speed, std::optional<std::array<double, 3>> pose) {
  const ParkingPhase phase = self.parking_phase();
  const bool parks =
      phase != ParkingPhase::Off && phase != ParkingPhase::Done && phase != ParkingPhase::Failed;
  require(std::isfinite(left) && std::isfinite(right) && std::isfinite(yaw_rate) &&
              std::isfinite(speed),
          "compute wants finite belt rates [rad/s], yaw rate [rad/s] and speed [m/s]");
  require(pose.has_value() || !parks, "compute wants the pose (x, y, yaw) while the robot parks");
  DriveState state{left, right, yaw_rate, speed, {}};
  if (pose) {
    state.pose = {(*pose)[0], (*pose)[1], (*pose)[2]};
    require(
        std::isfinite(state.pose.x) && std::isfinite(state.pose.y) && std::isfinite(state.pose.yaw),
        "compute wants a finite pose (x, y, yaw)");
  }
  const DriveTorques torques = self.compute(state);
  return {torques.left, torques.right};
}

void bind_options(py::module_& module) {
  py::class_<SpeedLimits>(module, "SpeedLimits", kSpeedLimits)
      .def(py::init(
               [](double acceleration, double jerk) { return SpeedLimits{acceleration, jerk}; }),
           "acceleration"_a, "jerk"_a)
      .def_readwrite("acceleration", &SpeedLimits::acceleration, "[m/s^2] or [rad/s^2]")
      .def_readwrite("jerk", &SpeedLimits::jerk, "[m/s^3] or [rad/s^3]");
  using Park = ParkingOptions;
  const Park park;
  py::class_<Park>(module, "ParkingOptions", kParkingOptions)
      .def(py::init([](double speed, double yaw_rate, double deceleration, double turn_centre,
                       double run_in, double line_gain, double heading_gain, double max_offset,
                       double max_turn, int attempts, double patience) {
             return Park{speed,        yaw_rate,   deceleration, turn_centre, run_in,  line_gain,
                         heading_gain, max_offset, max_turn,     attempts,    patience};
           }),
           py::kw_only(), "speed"_a = park.speed, "yaw_rate"_a = park.yaw_rate,
           "deceleration"_a = park.deceleration, "turn_centre"_a = park.turn_centre,
           "run_in"_a = park.run_in, "line_gain"_a = park.line_gain,
           "heading_gain"_a = park.heading_gain, "max_offset"_a = park.max_offset,
           "max_turn"_a = park.max_turn, "attempts"_a = park.attempts, "patience"_a = park.patience)
      .def_readwrite("speed", &Park::speed, "[m/s]")
      .def_readwrite("yaw_rate", &Park::yaw_rate, "[rad/s]")
      .def_readwrite("deceleration", &Park::deceleration, "[m/s^2]")
      .def_readwrite("turn_centre", &Park::turn_centre, "[m]")
      .def_readwrite("run_in", &Park::run_in, "[m]")
      .def_readwrite("line_gain", &Park::line_gain, "[rad/m]")
      .def_readwrite("heading_gain", &Park::heading_gain, "[1/s]")
      .def_readwrite("max_offset", &Park::max_offset, "[m]")
      .def_readwrite("max_turn", &Park::max_turn, "[rad]")
      .def_readwrite("attempts", &Park::attempts)
      .def_readwrite("patience", &Park::patience);
}

void bind_drive_options(py::module_& module) {
  using Drive = DriveOptions;
  const Drive d;
  py::class_<Drive>(module, "DriveOptions", kDriveOptions)
      .def(py::init([](double dt, double radius, double gauge, double mass, double max_torque,
                       double max_power, double max_speed, double max_yaw_rate, double max_sideways,
                       const SpeedLimits& forward, const SpeedLimits& turning, double gain,
                       double integral_gain, double speed_gain, double yaw_gain,
                       double yaw_integral_gain, double slip_speed, double slip_ratio,
                       double standstill_time, double brake_time, const ParkingOptions& parking) {
             return Drive{dt,
                          radius,
                          gauge,
                          mass,
                          max_torque,
                          max_power,
                          max_speed,
                          max_yaw_rate,
                          max_sideways,
                          forward,
                          turning,
                          gain,
                          integral_gain,
                          speed_gain,
                          yaw_gain,
                          yaw_integral_gain,
                          slip_speed,
                          slip_ratio,
                          standstill_time,
                          brake_time,
                          parking};
           }),
           py::kw_only(), "dt"_a = d.dt, "radius"_a = d.radius, "gauge"_a = d.gauge,
           "mass"_a = d.mass, "max_torque"_a = d.max_torque, "max_power"_a = d.max_power,
           "max_speed"_a = d.max_speed, "max_yaw_rate"_a = d.max_yaw_rate,
           "max_sideways"_a = d.max_sideways, "forward"_a = d.forward, "turning"_a = d.turning,
           "gain"_a = d.gain, "integral_gain"_a = d.integral_gain, "speed_gain"_a = d.speed_gain,
           "yaw_gain"_a = d.yaw_gain, "yaw_integral_gain"_a = d.yaw_integral_gain,
           "slip_speed"_a = d.slip_speed, "slip_ratio"_a = d.slip_ratio,
           "standstill_time"_a = d.standstill_time, "brake_time"_a = d.brake_time,
           "parking"_a = d.parking)
      .def_readwrite("dt", &Drive::dt, "[s]")
      .def_readwrite("radius", &Drive::radius, "[m]")
      .def_readwrite("gauge", &Drive::gauge, "[m]")
      .def_readwrite("mass", &Drive::mass, "[kg]")
      .def_readwrite("max_torque", &Drive::max_torque, "[N m]")
      .def_readwrite("max_power", &Drive::max_power, "[W]")
      .def_readwrite("max_speed", &Drive::max_speed, "[m/s]")
      .def_readwrite("max_yaw_rate", &Drive::max_yaw_rate, "[rad/s]")
      .def_readwrite("max_sideways", &Drive::max_sideways, "[m/s^2]")
      .def_readwrite("forward", &Drive::forward, "SpeedLimits")
      .def_readwrite("turning", &Drive::turning, "SpeedLimits")
      .def_readwrite("gain", &Drive::gain, "[N m s/rad]")
      .def_readwrite("integral_gain", &Drive::integral_gain, "[N m/rad]")
      .def_readwrite("speed_gain", &Drive::speed_gain)
      .def_readwrite("yaw_gain", &Drive::yaw_gain)
      .def_readwrite("yaw_integral_gain", &Drive::yaw_integral_gain, "[1/s]")
      .def_readwrite("slip_speed", &Drive::slip_speed, "[m/s]")
      .def_readwrite("slip_ratio", &Drive::slip_ratio)
      .def_readwrite("standstill_time", &Drive::standstill_time, "[s]")
      .def_readwrite("brake_time", &Drive::brake_time, "[s]")
      .def_readwrite("parking", &Drive::parking, "ParkingOptions");
}

}  // namespace

void bind_drive(py::module_& module) {
  bind_options(module);
  bind_drive_options(module);
  py::enum_<ParkingPhase>(module, "ParkingPhase", kPhase)
      .value("Off", ParkingPhase::Off)
      .value("Face", ParkingPhase::Face)
      .value("Approach", ParkingPhase::Approach)
      .value("Align", ParkingPhase::Align)
      .value("RunIn", ParkingPhase::RunIn)
      .value("Done", ParkingPhase::Done)
      .value("Failed", ParkingPhase::Failed);
  const auto reference = [](const DriveController& self) {
    return std::array<double, 2>{self.reference().speed, self.reference().yaw_rate};
  };
  const auto drive = [](DriveController& self, double speed, double yaw_rate) {
    self.drive({speed, yaw_rate});
  };
  const auto park = [](DriveController& self, double x, double y, double yaw) {
    self.park({x, y, yaw});
  };
  py::class_<DriveController>(module, "DriveController", kController)
      .def(py::init<const DriveOptions&>(), "options"_a = DriveOptions{})
      .def("drive", drive, "speed"_a, "yaw_rate"_a = 0.0, kDrive)
      .def("park", park, "x"_a, "y"_a, "yaw"_a, kPark)
      .def("compute", &compute, "left"_a, "right"_a, "yaw_rate"_a, "speed"_a, "pose"_a = py::none(),
           kCompute)
      .def("reset", &DriveController::reset, "Stands, braked, knows nothing of the ground.")
      .def("state", &state<DriveController>, kState)
      .def("restore", &restore<DriveController>, "state"_a, kRestore)
      .def_property_readonly("options", &DriveController::options, py::return_value_policy::copy)
      .def_property_readonly("braked", &DriveController::braked, kBraked)
      .def_property_readonly("slipping", &DriveController::slipping,
                             "whether a belt was held back in the last period")
      .def_property_readonly("gauge", &DriveController::gauge, "[m] effective, as estimated")
      .def_property_readonly("parking_phase", &DriveController::parking_phase)
      .def_property_readonly("reference", reference,
                             "(2,) speed [m/s] and yaw rate [rad/s] of the moment");
}
