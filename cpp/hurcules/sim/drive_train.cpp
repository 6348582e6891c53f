#include "hurcules/sim/drive_train.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// reads `transmission_JOINT`; false without one
bool read_transmission(const mjModel* m, int joint, Transmission& found) {
  const std::string marker = "transmission_", name = name_of(*m, mjOBJ_JOINT, joint);
  const std::string numeric = marker + name;
  const int id = find_numeric(m, marker, name);
  if (id < 0) return false;
  require(m->numeric_size[id] == 5,
          "numeric '" + numeric +
              "' wants 5 numbers (low, high, lag, efficiency, governed), it has " +
              std::to_string(m->numeric_size[id]));
  const mjtNum* const data = m->numeric_data + m->numeric_adr[id];
  found = {data[0], data[1], data[2], data[3], data[4]};
  require(found.high > 0.0 && found.low >= found.high && found.lag >= 0.0 &&
              found.efficiency > 0.0 && found.efficiency <= 1.0 && found.governed > 0.0,
          "numeric '" + numeric +
              "' wants low >= high > 0, lag >= 0, 0 < efficiency <= 1, governed > 0");
  return true;
}

}  // namespace

double Transmission::steady(double speed, double peak) const {
  const double turning = std::abs(speed);
  return turning * low > governed * peak ? std::clamp(governed * peak / turning, high, low) : low;
}

DriveTrain::DriveTrain(const mjModel* m) : dt_(m->opt.timestep), ratio_(Vector::Ones(m->nu)) {
  for (int actuator = 0; actuator < m->nu; ++actuator) {
    Transmission transmission;
    const int joint = m->actuator_trnid[2 * actuator];
    if (m->actuator_trntype[actuator] != mjTRN_JOINT) continue;
    if (!read_transmission(m, joint, transmission)) continue;
    // the model's limits are those of the joint: torque in the lowest gear, speed in the highest
    MotorLimits motor = read_motor_limits(m, actuator);
    motor.peak /= transmission.low;
    motor.speed *= transmission.high;
    drives_.push_back({actuator, m->jnt_dofadr[joint], gear_of(*m, actuator), transmission, motor});
    ratio_[actuator] = transmission.low;
  }
  asked_.resize(drives_.size());
}

void DriveTrain::reset(const mjData* d) {
  for (const Drive& drive : drives_) {
    ratio_[drive.actuator] = drive.transmission.steady(d->qvel[drive.dof], drive.motor.speed);
  }
}

void DriveTrain::limit(mjData* d) {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const Drive& drive = drives_[i];
    mjtNum& control = d->ctrl[drive.actuator];
    asked_[i] = control;
    const EffortRange allowed = range(drive.actuator, d->qvel[drive.dof]);
    control = std::clamp(control * drive.gear, allowed.lower, allowed.upper) / drive.gear;
  }
}

void DriveTrain::advance(mjData* d) {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const Drive& drive = drives_[i];
    d->ctrl[drive.actuator] = asked_[i];
    double& ratio = ratio_[drive.actuator];
    const double wanted = drive.transmission.steady(d->qvel[drive.dof], drive.motor.speed);
    ratio += (wanted - ratio) * std::min(1.0, dt_ / std::max(drive.transmission.lag, dt_));
  }
}

const DriveTrain::Drive* DriveTrain::find(int actuator) const {
  const auto found = std::find_if(drives_.begin(), drives_.end(), [actuator](const Drive& drive) {
    return drive.actuator == actuator;
  });
  return found == drives_.end() ? nullptr : &*found;
}

double DriveTrain::efficiency(int actuator) const {
  const Drive* const drive = find(actuator);
  return drive ? drive->transmission.efficiency : 1.0;
}

EffortRange DriveTrain::range(int actuator, double speed) const {
  const Drive* const drive = find(actuator);
  if (!drive) return {-kNone, kNone};
  const double ratio = ratio_[actuator];
  const EffortRange motor = drive->motor.at(ratio * speed);
  return {ratio * motor.lower, ratio * motor.upper};
}

const MotorLimits& DriveTrain::motor(int actuator) const {
  const Drive* const drive = find(actuator);
  require(drive != nullptr,
          "actuator " + std::to_string(actuator) +
              " has no transmission: its joint wants a numeric transmission_JOINT");
  return drive->motor;
}

void DriveTrain::save(StateWriter& writer) const {
  writer.put(ratio_);
}

void DriveTrain::restore(StateReader& reader) {
  reader.get(ratio_);
}

}  // namespace hurcules
