#include "hurcules/sim/realistic_sensors.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "hurcules/sim/sensor_setups.hpp"

namespace hurcules {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // [rad]
constexpr double kTurn = 2.0 * std::numbers::pi;      // [rad]
constexpr double kEncoderSteps = 524288;  // a turn of an absolute encoder at the joint: 19 bits
constexpr double kStep = kTurn / kEncoderSteps;  // [rad]
constexpr double kGravity = 9.81;                // [m/s^2]
constexpr double kBandwidth = 500.0;             // [Hz] of the inertial sensors, Nyquist of 1 kHz

}  // namespace

SensorOptions realistic_sensors() {
  const double density = kGravity * 100e-6;  // [m/s^2/sqrt(Hz)] MEMS: 100 ug/sqrt(Hz)
  const double gyro = 0.01 * kDegree;        // [rad/s/sqrt(Hz)] MEMS: 0.01 deg/s/sqrt(Hz)
  const double samples = std::sqrt(kBandwidth);
  SensorOptions options;
  options.models = {
      // one bit of noise; one cycle of EtherCAT until it is read
      {kEncoderPosition, {.noise = kStep, .delay = 1, .step = kStep}},
      // as a drive reckons it: differences of its own faster samples, filtered to 1 mrad/s
      {kEncoderSpeed, {.noise = 1e-3, .delay = 1}},
      {"imu_acceleration", {.noise = density * samples, .bias = 0.02, .drift = 5e-4, .delay = 1}},
      {"imu_rate", {.noise = gyro * samples, .bias = 0.2 * kDegree, .drift = 1e-5, .delay = 1}},
      // load cells: 0.2 % of 5 kN
      {"load", {.noise = 10.0, .bias = 20.0, .delay = 1, .step = 1.0}},
      // from the encoder of the sprocket
      {"track_speed", {.noise = 5e-3, .delay = 1}},
      // satellite positions with carrier phase, fused with the IMU; 20 ms until they are there
      {"pose_position", {.noise = 2e-3, .bias = 0.01, .drift = 1e-3, .delay = 20}},
      {kPoseRotation, {.noise = 5e-4, .bias = 1e-3, .delay = 5}},
      {"pose_velocity", {.noise = 0.02, .delay = 20}},
      {"pose_rate", {.noise = gyro * samples, .delay = 1}},
  };
  // a scanner of 270 degrees, 0.75 degrees a ray, 40 Hz, 30 m, 1 cm
  options.range.rays = 361;
  options.range.period = 25;
  options.range.model = {.noise = 0.01, .step = 0.001};
  return options;
}

SensorOptions realistic_sensors(const Robot& robot) {
  SensorOptions options = realistic_sensors();
  const mjModel* const model = robot.model().get();
  std::set<std::string> there;
  for (const SensorSetup& setup : find_sensors(model, robot.root_bodies()))
    there.insert(setup.name);
  std::erase_if(options.models, [&](const auto& named) { return !there.contains(named.first); });
  if (mj_name2id(model, mjOBJ_SITE, options.range.site.c_str()) < 0) options.range.rays = 0;
  return options;
}

}  // namespace hurcules
