#include "hurcules/sim/servo.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

// of the peak that a reference may ask for: rounding carries it no further
constexpr double kShare = 1.0 - 1e-12;

const ServoRow& row_of(const std::vector<ServoRow>& table, const std::string& joint) {
  std::vector<std::string> names;
  for (const ServoRow& row : table) {
    if (row.joint == joint) return row;
    names.push_back(row.joint);
  }
  throw Error(unknown_name("servo of joint", joint, names));
}

std::string joint_name(const mjModel* m, int joint) {
  const char* const name = mj_id2name(m, mjOBJ_JOINT, joint);
  return name ? name : "";
}

void require_motor(const mjModel* m, int actuator, const std::string& joint) {
  require(m->actuator_gaintype[actuator] == mjGAIN_FIXED &&
              m->actuator_biastype[actuator] == mjBIAS_NONE &&
              m->actuator_gainprm[mjNGAIN * actuator] == 1.0,
          "the actuator of joint '" + joint + "' wants to be a motor: the servo commands torque");
}

}  // namespace

Servo::Servo(const Robot& robot, const std::vector<ServoRow>& table, double dt)
    : pid_(triple_pole({}, dt)) {
  const mjModel* const m = robot.model().get();
  std::vector<JointDrive> drives;
  std::vector<bool> taken(static_cast<std::size_t>(m->nu), false);
  const auto add = [&](Motor motor, int joint) {
    names_.push_back(joint_name(m, joint));
    require_motor(m, motor.actuator, names_.back());
    motor.qpos = m->jnt_qposadr[joint];
    motor.dof = m->jnt_dofadr[joint];
    motor.gear = m->actuator_gear[6 * motor.actuator];
    motor.limits = read_motor_limits(m, motor.actuator);
    motors_.push_back(motor);
    taken[static_cast<std::size_t>(motor.actuator)] = true;
    const ServoRow& row = row_of(table, names_.back());
    drives.push_back({row.inertia, row.bandwidth, motor.limits.peak});
  };
  for (Index i = 0; i < robot.size(); ++i) {
    for (const DrivenJoint& joint : robot.coordinates()[static_cast<std::size_t>(i)].joints) {
      if (joint.actuator < 0) continue;
      add({.actuator = joint.actuator, .coordinate = i, .factor = joint.factor}, joint.joint);
    }
  }
  coordinate_joints_ = motors_.size();
  for (int a = 0; a < m->nu; ++a) {
    if (taken[static_cast<std::size_t>(a)] || m->actuator_trntype[a] != mjTRN_JOINT) continue;
    add({.actuator = a}, m->actuator_trnid[2 * a]);
  }
  pid_ = JointPid(triple_pole(drives, dt));
  error_.position = error_.velocity = place_ = Vector::Zero(pid_.size());
  rests_.resize(motors_.size());
  window_.lower = window_.upper = Vector::Zero(robot.size());
}

void Servo::mind(const Brakes& brakes) {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const bool shut = brakes.is_shut(motors_[i].actuator);
    rests_[i] = {shut, rests_[i].on && !shut, brakes.load(motors_[i].actuator)};
  }
}

void Servo::act(const Reference& reference, mjData* data) {
  act(reference, data->qpos, data->qvel, data);
}

void Servo::act(const Reference& reference, const Sensed& sensed, mjData* data) {
  act(reference, sensed.qpos.data(), sensed.qvel.data(), data);
}

void Servo::act(const Reference& reference, const double* qpos, const double* qvel, mjData* data) {
  measure(reference, qpos, qvel);
  set_limits(data);
  const Vector& torque = pid_.compute(error_);
  for (Index i = 0; i < pid_.size(); ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    data->ctrl[motor.actuator] = torque[i] / motor.gear;
  }
}

// errors of the joints; what held its place behind a brake holds where the brake left it
void Servo::measure(const Reference& reference, const double* qpos, const double* qvel) {
  for (Index i = 0; i < pid_.size(); ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    const bool driven = motor.coordinate >= 0;
    const Rest& rest = rests_[static_cast<std::size_t>(i)];
    if (rest.on || rest.over) place_[i] = qpos[motor.qpos];
    const double position =
        driven ? motor.factor * reference.position[motor.coordinate] : place_[i];
    const double velocity = driven ? motor.factor * reference.velocity[motor.coordinate] : 0.0;
    error_.position[i] = position - qpos[motor.qpos];
    error_.velocity[i] = velocity - qvel[motor.dof];
  }
}

const RateWindow& Servo::find_window(const Vector& q_des, const Sensed& sensed) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  window_.lower.setConstant(-kNone);
  window_.upper.setConstant(kNone);
  for (Index i = 0; i < static_cast<Index>(coordinate_joints_); ++i) {
    if (rests_[static_cast<std::size_t>(i)].on) continue;
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    error_.position[i] = motor.factor * q_des[motor.coordinate] - sensed.qpos[motor.qpos];
    error_.velocity[i] = -sensed.qvel[motor.dof];
    const double peak = kShare * pid_.options().max_torque[i];
    const double a = pid_.rate_at(i, error_, -peak) / motor.factor;
    const double b = pid_.rate_at(i, error_, peak) / motor.factor;
    double& lower = window_.lower[motor.coordinate];
    double& upper = window_.upper[motor.coordinate];
    lower = std::max(lower, std::min(a, b));
    upper = std::min(upper, std::max(a, b));
    if (lower > upper) lower = upper = 0.5 * (lower + upper);
  }
  return window_;
}

// by speed and by brake
void Servo::set_limits(const mjData* data) {
  for (Index i = 0; i < pid_.size(); ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    const Rest& rest = rests_[static_cast<std::size_t>(i)];
    pid_.limit(i, rest.on ? EffortRange{} : motor.limits.at(data->qvel[motor.dof]));
    if (rest.over) pid_.take_over(i, error_, rest.torque);
  }
}

void Servo::reset(const mjData* data) {
  pid_.reset();
  error_.position.setZero();
  error_.velocity.setZero();
  for (Rest& rest : rests_) rest = {};
  for (Index i = 0; i < pid_.size(); ++i) {
    place_[i] = data->qpos[motors_[static_cast<std::size_t>(i)].qpos];
  }
}

void Servo::save(StateWriter& writer) const {
  pid_.save(writer);
  writer.put(place_);
  for (const Rest& rest : rests_) writer.put(rest.on ? 1.0 : 0.0);
}

void Servo::restore(StateReader& reader) {
  pid_.restore(reader);
  reader.get(place_);
  for (Rest& rest : rests_) rest = {.on = reader.get_count(1) > 0};
}

}  // namespace hurcules
