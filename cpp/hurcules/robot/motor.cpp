#include "hurcules/robot/motor.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
// no-load speed over peak speed: the torque fades out between them, slowly enough that a step of
// 1 ms does not make the lightest joint chatter
constexpr double kNoLoad = 1.1;

// inf without one
double find_limit(const mjModel* m, const std::string& marker, const std::string& joint) {
  const int numeric = find_numeric(m, marker, joint);
  if (numeric < 0) return kNone;
  const double limit = m->numeric_data[m->numeric_adr[numeric]];
  require(limit > 0.0, "numeric '" + marker + joint + "' wants a number above 0, " +
                           number_text(limit) + " came");
  return limit;
}

bool moves_joint(const mjModel* m, int actuator) {
  const int kind = m->actuator_trntype[actuator];
  return kind == mjTRN_JOINT || kind == mjTRN_JOINTINPARENT;
}

// what a range about 0 allows both ways
double smaller_side(const mjtNum* range) {
  return std::min(-range[0], range[1]);
}

}  // namespace

double peak_effort(const mjModel* m, int actuator) {
  double force = kNone;
  if (m->actuator_forcelimited[actuator])
    force = smaller_side(m->actuator_forcerange + 2 * actuator);
  const bool plain = m->actuator_gaintype[actuator] == mjGAIN_FIXED &&
                     m->actuator_biastype[actuator] == mjBIAS_NONE;
  if (plain && m->actuator_ctrllimited[actuator]) {
    const double gain = std::abs(m->actuator_gainprm[mjNGAIN * actuator]);
    force = std::min(force, gain * smaller_side(m->actuator_ctrlrange + 2 * actuator));
  }
  const double peak = force * std::abs(gear_of(*m, actuator));
  const int joint = m->actuator_trnid[2 * actuator];
  if (!m->jnt_actfrclimited[joint]) return peak;
  return std::min(peak, smaller_side(m->jnt_actfrcrange + 2 * joint));
}

EffortRange MotorLimits::at(double velocity) const {
  const double v = std::abs(velocity);
  double driving = v > 0.0 ? std::min(peak, power / v) : peak;
  if (v > speed) {
    const double left = (kNoLoad * speed - v) / ((kNoLoad - 1.0) * speed);
    driving *= std::max(left, 0.0);
  }
  return velocity >= 0.0 ? EffortRange{-peak, driving} : EffortRange{-driving, peak};
}

int find_numeric(const mjModel* m, const std::string& marker, const std::string& joint) {
  for (int i = 0; i < m->nnumeric; ++i) {
    const std::string name = name_of(*m, mjOBJ_NUMERIC, i);
    const std::size_t at = name.find(marker);
    if (at == std::string::npos) continue;
    if (name.substr(0, at) + name.substr(at + marker.size()) == joint) return i;
  }
  return -1;
}

MotorLimits read_motor_limits(const mjModel* m, int actuator) {
  require(actuator >= 0 && actuator < m->nu && moves_joint(m, actuator),
          "a motor wants to be an actuator of a joint, number " + std::to_string(actuator) +
              " of " + std::to_string(m->nu) + " is none");
  const std::string joint = name_of(*m, mjOBJ_JOINT, m->actuator_trnid[2 * actuator]);
  MotorLimits limits;
  limits.peak = peak_effort(m, actuator);
  limits.speed = find_limit(m, "velocity_limit_", joint);
  require(limits.peak > 0.0, "the motor of joint '" + joint +
                                 "' wants a forcerange that spans 0, and such a ctrlrange and a "
                                 "gear: it can give no torque");
  limits.power = std::min(find_limit(m, "power_limit_", joint), limits.peak * limits.speed);
  return limits;
}

MotorPower::MotorPower(const MotorLimits& limits, const MotorLosses& losses) : losses_(losses) {
  require(losses.efficiency > 0.0 && losses.efficiency <= 1.0,
          "efficiency wants a number above 0 and up to 1");
  require(losses.regeneration >= 0.0 && losses.regeneration <= 1.0,
          "regeneration wants a number from 0 to 1");
  require(std::isfinite(losses.heat_at_peak) && losses.heat_at_peak >= 0.0,
          "heat_at_peak wants a number >= 0");
  // a motor without limits is ideal: its windings have no size to reckon with
  if (std::isfinite(limits.peak) && std::isfinite(limits.power)) {
    resistance_ = losses.heat_at_peak * limits.power / (limits.peak * limits.peak);
  }
}

double MotorPower::at(double effort, double velocity) const {
  const double mechanical = effort * velocity;
  const double heat = resistance_ * effort * effort;
  if (mechanical >= 0.0) return mechanical / losses_.efficiency + heat;
  return heat + losses_.regeneration * mechanical;
}

}  // namespace hurcules
