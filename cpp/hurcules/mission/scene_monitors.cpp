#include "hurcules/mission/scene_monitors.hpp"

#include <algorithm>

namespace hurcules {

void SceneMonitors::attach(const MissionSetup& setup, const Plant& plant, Recorder& log) {
  model_ = plant.model();
  data_ = plant.data();
  if (!setup.casualty.empty()) {
    casualty_ = std::make_unique<CasualtyMonitor>(model_, setup.casualty, setup.stand_off);
    casualty_->add_log_channels(log);
  }
  if (setup.load.empty()) return;
  load_ = std::make_unique<LoadMonitor>(model_, setup.load, setup.container);
  load_->add_log_channels(log, "load");
  places_.reserve(2);  // the log reads where they are
  places_.emplace_back("load", PlaceMonitor(model_, setup.load, setup.stand_off));
  if (!setup.container.empty()) {
    places_.emplace_back("container", PlaceMonitor(model_, setup.container, setup.container_stand));
  }
  for (const auto& [prefix, place] : places_) place.add_log_channels(log, prefix);
  errors_.assign(places_.size(), Vector::Zero(4));
}

void SceneMonitors::draw_errors(Random& random, double scale) {
  for (Vector& error : errors_) {
    for (double& part : error) part = scale * std::clamp(random.normal(), -2.0, 2.0);
  }
}

void SceneMonitors::reset() {
  if (casualty_) casualty_->reset();
  if (load_) load_->reset(model_, data_);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    places_[i].second.set_error(errors_[i]);
    places_[i].second.look(model_, data_);
  }
}

void SceneMonitors::look() {
  if (casualty_) casualty_->look(model_, data_);
  if (load_) load_->look(model_, data_);
  for (auto& [prefix, place] : places_) place.look(model_, data_);
}

void SceneMonitors::save(StateWriter& writer) const {
  if (casualty_) casualty_->save(writer);
  if (load_) load_->save(writer);
  for (const auto& [prefix, place] : places_) place.save(writer);
}

void SceneMonitors::restore(StateReader& reader) {
  if (casualty_) casualty_->restore(reader);
  if (load_) load_->restore(reader);
  for (auto& [prefix, place] : places_) place.restore(reader);
}

}  // namespace hurcules
