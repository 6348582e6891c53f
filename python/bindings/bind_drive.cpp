// control: the drive controller.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/control/track_drive.hpp"
#include "options.hpp"
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
  max_power: [W] of one drive, driving.
  max_braking_power: [W] of one drive, braking: where a transmission lets less torque through at speed.
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
  speed: [m/s] along the ground, up and down slopes too, by heading.
  pose: (x, y, yaw) [m, m, rad]; wanted while the robot parks.

Returns:
  (left, right) torques of the drives [N m]; see also `braked`.

Raises:
  Error: a measurement is not finite, or the pose is missing.
)";
constexpr const char* kTrackDrive =
    R"(What the drive controller of a robot measures, from its joints and its root.

Args:
  robot: Robot with a free joint at its root.
  options: DriveOptions.
  left: joint of the left driven belt.
  right: of the right one.

Raises:
  Error: a belt without an actuator, a robot without a free root, or an option out of range.
)";
constexpr const char* kMeasure = R"(What belts, gyro and localisation tell.

Args:
  qpos: (nq,) of the model.
  qvel: (nv,) of the model.

Raises:
  Error: arrays of another size.
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

DriveState measure(const TrackDrive& self, const Vector& qpos, const Vector& qvel) {
  require(self.fits(qpos, qvel), "measure wants qpos and qvel of the robot's model, " +
                                     std::to_string(qpos.size()) + " and " +
                                     std::to_string(qvel.size()) + " numbers came");
  return self.measure({qpos, qvel, {}});
}

void bind_track_drive(py::module_& module) {
  py::class_<DriveState>(module, "DriveState", "What the drive controller measures.")
      .def_readonly("left", &DriveState::left, "[rad/s] of the driven belt, > 0 forward")
      .def_readonly("right", &DriveState::right, "[rad/s]")
      .def_readonly("yaw_rate", &DriveState::yaw_rate, "[rad/s] about the vertical")
      .def_readonly("speed", &DriveState::speed,
                    "[m/s] along the ground, up and down slopes too, by heading")
      .def_property_readonly(
          "pose",
          [](const DriveState& self) {
            return std::array<double, 3>{self.pose.x, self.pose.y, self.pose.yaw};
          },
          "(x, y, yaw) of the root [m, m, rad]");
  py::class_<TrackDrive>(module, "TrackDrive", kTrackDrive)
      .def(py::init([](const Robot& robot, const DriveOptions& options, const std::string& left,
                       const std::string& right) {
             return TrackDrive(robot, {.left = left, .right = right, .drive = options});
           }),
           "robot"_a, "options"_a = DriveOptions{}, "left"_a = TrackDriveOptions{}.left,
           "right"_a = TrackDriveOptions{}.right)
      .def("measure", &measure, "qpos"_a, "qvel"_a, kMeasure)
      .def_property_readonly(
          "controller", [](TrackDrive& self) -> DriveController& { return self.controller(); },
          py::return_value_policy::reference_internal);
}

void bind_parking_options(py::module_& module) {
  bind_options<SpeedLimits>(
      module, "SpeedLimits", kSpeedLimits,
      {required("acceleration", &SpeedLimits::acceleration, "[m/s^2] or [rad/s^2]"),
       required("jerk", &SpeedLimits::jerk, "[m/s^3] or [rad/s^3]")},
      Arguments::Positional);
  using Park = ParkingOptions;
  bind_options<Park>(
      module, "ParkingOptions", kParkingOptions,
      {field("speed", &Park::speed, "[m/s]"), field("yaw_rate", &Park::yaw_rate, "[rad/s]"),
       field("deceleration", &Park::deceleration, "[m/s^2]"),
       field("turn_centre", &Park::turn_centre, "[m]"), field("run_in", &Park::run_in, "[m]"),
       field("line_gain", &Park::line_gain, "[rad/m]"),
       field("heading_gain", &Park::heading_gain, "[1/s]"),
       field("max_offset", &Park::max_offset, "[m]"), field("max_turn", &Park::max_turn, "[rad]"),
       field("attempts", &Park::attempts), field("patience", &Park::patience)});
}

void bind_drive_options(py::module_& module) {
  using Drive = DriveOptions;
  bind_options<Drive>(module, "DriveOptions", kDriveOptions,
                      {field("dt", &Drive::dt, "[s]"),
                       field("radius", &Drive::radius, "[m]"),
                       field("gauge", &Drive::gauge, "[m]"),
                       field("mass", &Drive::mass, "[kg]"),
                       field("max_torque", &Drive::max_torque, "[N m]"),
                       field("max_power", &Drive::max_power, "[W]"),
                       field("max_braking_power", &Drive::max_braking_power, "[W]"),
                       field("max_speed", &Drive::max_speed, "[m/s]"),
                       field("max_yaw_rate", &Drive::max_yaw_rate, "[rad/s]"),
                       field("max_sideways", &Drive::max_sideways, "[m/s^2]"),
                       field("forward", &Drive::forward, "SpeedLimits"),
                       field("turning", &Drive::turning, "SpeedLimits"),
                       field("gain", &Drive::gain, "[N m s/rad]"),
                       field("integral_gain", &Drive::integral_gain, "[N m/rad]"),
                       field("speed_gain", &Drive::speed_gain),
                       field("yaw_gain", &Drive::yaw_gain),
                       field("yaw_integral_gain", &Drive::yaw_integral_gain, "[1/s]"),
                       field("slip_speed", &Drive::slip_speed, "[m/s]"),
                       field("slip_ratio", &Drive::slip_ratio),
                       field("standstill_time", &Drive::standstill_time, "[s]"),
                       field("brake_time", &Drive::brake_time, "[s]"),
                       field("parking", &Drive::parking, "ParkingOptions")});
}

}  // namespace

void bind_drive(py::module_& module) {
  bind_parking_options(module);
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
  bind_track_drive(module);
}
