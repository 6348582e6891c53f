#include "hurcules/sim/plant.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

constexpr int kState = mjSTATE_INTEGRATION;

using Data = std::unique_ptr<mjData, void (*)(mjData*)>;

Data own_or_borrow(const mjModel* model, mjData* borrowed) {
  require(model != nullptr, "a simulation wants a model, none came");
  Data data(mj_makeData(model), mj_deleteData);
  require(data != nullptr, "MuJoCo has no memory for this model");
  if (borrowed) {
    require(borrowed->nbuffer == data->nbuffer,
            "a simulation wants mjData of its model, that of another one came");
    return {borrowed, [](mjData*) {}};
  }
  return data;
}

bool all_sane(const mjtNum* values, mjtSize size) {
  for (mjtSize i = 0; i < size; ++i) {
    if (!(std::abs(values[i]) < mjMAXVAL)) return false;  // NaN too
  }
  return true;
}

}  // namespace

Plant::Plant(ModelPtr model, mjData* borrowed)
    : model_(std::move(model)),
      data_(own_or_borrow(model_.get(), borrowed)),
      tracks_(model_.get()),
      brakes_(model_.get()),
      drive_train_(model_.get()),
      actuators_(static_cast<std::size_t>(model_->nu)),
      state_(Vector::Zero(mj_stateSize(model_.get(), kState))),
      scratch_(Vector::Zero(model_->nv)) {
  const mjModel* const m = model_.get();
  for (int a = 0; a < m->nu; ++a) {
    const int kind = m->actuator_trntype[a];
    if (kind != mjTRN_JOINT && kind != mjTRN_JOINTINPARENT) continue;
    const int joint = m->actuator_trnid[2 * a];
    const int axis = m->jnt_type[joint] == mjJNT_BALL ? std::max(axis_of(*m, a), 0) : 0;
    motors_.push_back({a, m->jnt_dofadr[joint] + axis, read_motor_limits(m, a)});
  }
}

void Plant::place(const Vector& configuration) {
  qpos() = configuration;
  mj_kinematics(model_.get(), data_.get());
}

void Plant::load_springs() {
  const mjModel* const m = model_.get();
  mjData* const d = data_.get();
  for (int round = 0; round < 3; ++round) {  // the lever of a weight changes with the angle
    mj_comPos(m, d);
    mj_rne(m, d, 0, scratch_.data());
    for (int j = 0; j < m->njnt; ++j) {
      const int dof = m->jnt_dofadr[j], at = m->jnt_qposadr[j];
      const auto moves = [dof](const Motor& motor) { return motor.dof == dof; };
      if (m->jnt_type[j] != mjJNT_HINGE || m->jnt_stiffness[j] <= 0.0 ||
          std::any_of(motors_.begin(), motors_.end(), moves)) {
        continue;
      }
      d->qpos[at] = m->qpos_spring[at] - scratch_[dof] / m->jnt_stiffness[j];
      const double* const range = m->jnt_range + 2 * j;
      if (m->jnt_limited[j]) d->qpos[at] = std::clamp(d->qpos[at], range[0], range[1]);
    }
    mj_kinematics(m, d);
  }
}

void Plant::feel() {
  const mjModel* const m = model_.get();
  mjData* const d = data_.get();
  scratch_ = Eigen::Map<const Vector>(d->qacc_warmstart, m->nv);
  mj_fwdPosition(m, d);
  mj_sensorPos(m, d);
  mj_fwdVelocity(m, d);
  mj_sensorVel(m, d);
  std::fill_n(d->qfrc_actuator, m->nv, 0.0);
  mj_fwdAcceleration(m, d);
  mj_fwdConstraint(m, d);
  d->flg_rnepost = 0;
  mj_sensorAcc(m, d);
  std::copy(scratch_.begin(), scratch_.end(), d->qacc_warmstart);
}

void Plant::move(const Vector& configuration, double dt) {
  mj_differentiatePos(model_.get(), data_->qvel, dt, data_->qpos, configuration.data());
  qpos() = configuration;
  data_->time += dt;
}

void Plant::see() {
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
  mj_camlight(model_.get(), data_.get());
  mj_sensorPos(model_.get(), data_.get());
}

void Plant::push(int body, const Vector3& force) {
  require(body > 0 && body < model_->nbody, "a push wants a body from 1 to " +
                                                std::to_string(model_->nbody - 1) + ", got " +
                                                std::to_string(body));
  std::copy(force.begin(), force.end(), data_->xfrc_applied + 6 * body);
}

const std::vector<ActuatorStatus>& Plant::actuators() {
  for (const Motor& motor : motors_) {
    actuators_[static_cast<std::size_t>(motor.actuator)] = {motor.limits.at(data_->qvel[motor.dof]),
                                                            brakes_.is_shut(motor.actuator),
                                                            brakes_.load(motor.actuator)};
  }
  return actuators_;
}

int Plant::find_keyframe(const std::string& text) const {
  std::vector<std::string> names;
  for (int key = 0; key < model_->nkey; ++key) {
    names.push_back(name_of(*model_, mjOBJ_KEY, key));
    if (names.back().find(text) != std::string::npos) return key;
  }
  throw Error(unknown_name("keyframe", text, names));
}

Vector Plant::keyframe_qpos(int keyframe) const {
  return Eigen::Map<const Vector>(model_->key_qpos + keyframe * model_->nq, model_->nq);
}

int Plant::other_free_joint(int root) const {
  for (int j = 0; j < model_->njnt; ++j) {
    if (model_->jnt_type[j] == mjJNT_FREE && model_->body_rootid[model_->jnt_bodyid[j]] != root) {
      return model_->jnt_qposadr[j];
    }
  }
  return -1;
}

void Plant::reset(int keyframe) {
  if (keyframe < 0) {
    mj_resetData(model_.get(), data_.get());
  } else {
    mj_resetDataKeyframe(model_.get(), data_.get(), keyframe);
  }
  data_->time = 0.0;
  std::fill_n(data_->qvel, model_->nv, 0.0);
  std::fill_n(data_->ctrl, model_->nu, 0.0);
  brakes_.reset();
  drive_train_.reset(data_.get());
  sound_ = looks_sound();
}

int Plant::step(int n) {
  int done = 0;
  while (done < n && sound_) {
    const auto one_step = ++done == n ? hurcules::step : hurcules::step_unseen;
    one_step(model_.get(), data_.get(), tracks_, {&brakes_, &drive_train_});
    check();
  }
  return done;
}

bool Plant::check() {
  sound_ = sound_ && looks_sound();
  return sound_;
}

bool Plant::looks_sound() const {
  // a warning counts even where MuJoCo has quietly reset its data since
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_BADCTRL}) {
    if (data_->warning[warning].number > 0) return false;
  }
  return all_sane(data_->qpos, model_->nq) && all_sane(data_->qvel, model_->nv);
}

double Plant::dt() const {
  return model_->opt.timestep;
}
Eigen::Map<Vector> Plant::qpos() {
  return {data_->qpos, model_->nq};
}
Eigen::Map<const Vector> Plant::qpos() const {
  return {data_->qpos, model_->nq};
}
Eigen::Map<const Vector> Plant::qvel() const {
  return {data_->qvel, model_->nv};
}

void Plant::save(StateWriter& writer) const {
  mj_getState(model_.get(), data_.get(), state_.data(), kState);
  writer.put(state_);
  // what force tasks read in the next tick
  writer.put(Vector(Eigen::Map<const Vector>(data_->sensordata, model_->nsensordata)));
  writer.put(sound_ ? 1.0 : 0.0);
  brakes_.save(writer);
  drive_train_.save(writer);
}

void Plant::restore(StateReader& reader) {
  reader.get(state_);
  mj_setState(model_.get(), data_.get(), state_.data(), kState);
  Vector sensors = Vector::Zero(model_->nsensordata);
  reader.get(sensors);
  std::copy(sensors.begin(), sensors.end(), data_->sensordata);
  sound_ = reader.get() > 0.0;
  brakes_.restore(reader);
  drive_train_.restore(reader);
  for (mjWarningStat& warning : data_->warning) {
    if (sound_) warning.number = 0;
  }
}

}  // namespace hurcules
