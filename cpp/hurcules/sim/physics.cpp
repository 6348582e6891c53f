#include "hurcules/sim/physics.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

constexpr int kState = mjSTATE_INTEGRATION;

using Data = std::unique_ptr<mjData, void (*)(mjData*)>;

Data own_or_borrow(const mjModel* model, mjData* borrowed) {
  if (borrowed) return {borrowed, [](mjData*) {}};
  Data data(mj_makeData(model), mj_deleteData);
  require(data != nullptr, "MuJoCo has no memory for this model");
  return data;
}

bool all_sane(const mjtNum* values, mjtSize size) {
  for (mjtSize i = 0; i < size; ++i) {
    if (!(std::abs(values[i]) < mjMAXVAL)) return false;  // NaN too
  }
  return true;
}

}  // namespace

Physics::Physics(ModelPtr model, mjData* borrowed)
    : model_(std::move(model)),
      data_(own_or_borrow(model_.get(), borrowed)),
      tracks_(model_.get()),
      brakes_(model_.get()),
      drive_train_(model_.get()),
      state_(Vector::Zero(mj_stateSize(model_.get(), kState))) {}

int Physics::find_keyframe(const std::string& text) const {
  std::vector<std::string> names;
  for (int key = 0; key < model_->nkey; ++key) {
    const char* const name = mj_id2name(model_.get(), mjOBJ_KEY, key);
    names.emplace_back(name ? name : "");
    if (names.back().find(text) != std::string::npos) return key;
  }
  throw Error(unknown_name("keyframe", text, names));
}

void Physics::reset(int keyframe) {
  mj_resetDataKeyframe(model_.get(), data_.get(), keyframe);
  data_->time = 0.0;
  std::fill_n(data_->qvel, model_->nv, 0.0);
  std::fill_n(data_->ctrl, model_->nu, 0.0);
  brakes_.reset();
  drive_train_.reset(data_.get());
  sound_ = looks_sound();
}

int Physics::step(int n) {
  int done = 0;
  while (done < n && sound_) {
    const auto one_step = ++done == n ? hurcules::step : hurcules::step_unseen;
    one_step(model_.get(), data_.get(), tracks_, {&brakes_, &drive_train_});
    check();
  }
  return done;
}

bool Physics::check() {
  sound_ = sound_ && looks_sound();
  return sound_;
}

bool Physics::looks_sound() const {
  // a warning counts even where MuJoCo has quietly reset its data since
  for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_BADCTRL}) {
    if (data_->warning[warning].number > 0) return false;
  }
  return all_sane(data_->qpos, model_->nq) && all_sane(data_->qvel, model_->nv);
}

double Physics::dt() const {
  return model_->opt.timestep;
}
Eigen::Map<Vector> Physics::qpos() {
  return {data_->qpos, model_->nq};
}
Eigen::Map<const Vector> Physics::qpos() const {
  return {data_->qpos, model_->nq};
}
Eigen::Map<const Vector> Physics::qvel() const {
  return {data_->qvel, model_->nv};
}

void Physics::save(StateWriter& writer) const {
  mj_getState(model_.get(), data_.get(), state_.data(), kState);
  writer.put(state_);
  writer.put(sound_ ? 1.0 : 0.0);
  brakes_.save(writer);
  drive_train_.save(writer);
}

void Physics::restore(StateReader& reader) {
  reader.get(state_);
  mj_setState(model_.get(), data_.get(), state_.data(), kState);
  sound_ = reader.get() > 0.0;
  brakes_.restore(reader);
  drive_train_.restore(reader);
  for (mjWarningStat& warning : data_->warning) {
    if (sound_) warning.number = 0;
  }
}

}  // namespace hurcules
