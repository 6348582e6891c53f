#include "hurcules/sim/brakes.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/motor.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

// the dof that an actuator brakes, -1 when there is no friction row to write a brake into
int braked_dof(const mjModel* m, int actuator) {
  if (m->actuator_trntype[actuator] != mjTRN_JOINT || !m->actuator_forcelimited[actuator]) {
    return -1;
  }
  const int joint = m->actuator_trnid[2 * actuator];
  if (m->jnt_type[joint] != mjJNT_HINGE && m->jnt_type[joint] != mjJNT_SLIDE) return -1;
  const int dof = m->jnt_dofadr[joint];
  return m->dof_frictionloss[dof] > 0.0 ? dof : -1;
}

// calls action(row, dof) for every friction row of a joint
template <typename Action>
void each_friction_row(const mjData* d, Action&& action) {
  for (int row = d->ne; row < d->ne + d->nf; ++row) {
    if (d->efc_type[row] == mjCNSTR_FRICTION_DOF) action(row, d->efc_id[row]);
  }
}

}  // namespace

Brakes::Brakes(const mjModel* m, const BrakeOptions& options)
    : options_(options),
      dt_(m->opt.timestep),
      brakes_(static_cast<std::size_t>(m->nu)),
      brake_of_dof_(static_cast<std::size_t>(m->nv), -1),
      closed_(static_cast<std::size_t>(m->nu), false),
      grip_(Vector::Zero(m->nu)),
      load_(Vector::Zero(m->nu)) {
  require(std::isfinite(options.strength) && options.strength > 0.0,
          "the strength of brakes wants a number above 0");
  require(std::isfinite(options.time) && options.time >= 0.0, "brakes want a time >= 0 [s]");
  require(std::isfinite(options.coil_power) && options.coil_power >= 0.0,
          "the coils of brakes want a power >= 0 [W]");
  for (int actuator = 0; actuator < m->nu; ++actuator) {
    const int dof = braked_dof(m, actuator);
    if (dof < 0 || brake_of_dof_[static_cast<std::size_t>(dof)] >= 0) continue;  // one a joint
    brakes_[static_cast<std::size_t>(actuator)] = {
        name_of(*m, mjOBJ_JOINT, m->dof_jntid[dof]), dof,
        options.strength * read_motor_limits(m, actuator).peak};
    brake_of_dof_[static_cast<std::size_t>(dof)] = actuator;
  }
}

int Brakes::find(const std::string& joint) const {
  for (int actuator = 0; actuator < grip_.size(); ++actuator) {
    if (exists(actuator) && brake(actuator).joint == joint) return actuator;
  }
  throw Error(unknown_name("brake of joint", joint, names()));
}

std::vector<std::string> Brakes::names() const {
  std::vector<std::string> names;
  for (const Brake& brake : brakes_) {
    if (brake.torque > 0.0) names.push_back(brake.joint);
  }
  return names;
}

void Brakes::set_closed(int actuator, bool closed) {
  require(actuator >= 0 && actuator < grip_.size() && exists(actuator),
          "actuator " + std::to_string(actuator) +
              " has no brake: it wants to drive a joint with forcerange and frictionloss");
  closed_[static_cast<std::size_t>(actuator)] = closed;
}

void Brakes::close() {
  for (std::size_t i = 0; i < brakes_.size(); ++i) closed_[i] = brakes_[i].torque > 0.0;
}

void Brakes::reset(bool closed) {
  for (int actuator = 0; actuator < grip_.size(); ++actuator) {
    closed_[static_cast<std::size_t>(actuator)] = closed && exists(actuator);
    grip_[actuator] = closed && exists(actuator) ? 1.0 : 0.0;
  }
  load_.setZero();
}

void Brakes::tighten(mjData* d) const {
  each_friction_row(d, [&](int row, int dof) {
    const int actuator = brake_of_dof_[static_cast<std::size_t>(dof)];
    if (actuator < 0 || is_open(actuator)) return;
    const double torque = std::max(grip_[actuator] * max_load(actuator), d->efc_frictionloss[row]);
    d->efc_frictionloss[row] = torque;
    // the solver reads the row again in the order of the islands
    if (d->nisland > 0) d->iefc_frictionloss[d->map_efc2iefc[row]] = torque;
  });
}

void Brakes::advance(const mjData* d) {
  each_friction_row(d, [&](int row, int dof) {
    const int actuator = brake_of_dof_[static_cast<std::size_t>(dof)];
    if (actuator >= 0) load_[actuator] = d->efc_force[row];
  });
  const double step = options_.time > dt_ ? dt_ / options_.time : 1.0;
  for (int actuator = 0; actuator < grip_.size(); ++actuator) {
    const bool closing = closed_[static_cast<std::size_t>(actuator)];
    grip_[actuator] = std::clamp(grip_[actuator] + (closing ? step : -step), 0.0, 1.0);
  }
}

double Brakes::power() const {
  double power = 0.0;
  for (int actuator = 0; actuator < grip_.size(); ++actuator) {
    if (exists(actuator) && !closed_[static_cast<std::size_t>(actuator)]) {
      power += options_.coil_power;
    }
  }
  return power;
}

void Brakes::save(StateWriter& writer) const {
  for (const bool closed : closed_) writer.put(closed ? 1.0 : 0.0);
  writer.put(grip_);
  writer.put(load_);
}

void Brakes::restore(StateReader& reader) {
  for (std::size_t i = 0; i < closed_.size(); ++i) closed_[i] = reader.get_count(1) > 0;
  reader.get(grip_);
  reader.get(load_);
}

}  // namespace hurcules
