#include "hurcules/sim/sensor.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"

namespace hurcules {

namespace {

const double* array_of(const mjData* d, SensorSource::Array array) {
  switch (array) {
    case SensorSource::Array::Position:
      return d->qpos;
    case SensorSource::Array::Velocity:
      return d->qvel;
    case SensorSource::Array::Sensor:
      return d->sensordata;
  }
  return nullptr;
}

}  // namespace

void require_sensor_model(const std::string& sensor, const SensorModel& model) {
  const auto check = [&](const char* name, double value) {
    require(std::isfinite(value) && value >= 0.0, "sensor '" + sensor + "': " + name +
                                                      " wants a number >= 0, " +
                                                      number_text(value) + " came");
  };
  check("noise", model.noise);
  check("bias", model.bias);
  check("drift", model.drift);
  check("step", model.step);
  require(model.delay >= 0 && model.delay <= SensorModel::kMostDelay,
          "sensor '" + sensor + "': delay wants 0 to " + std::to_string(SensorModel::kMostDelay) +
              " samples, " + std::to_string(model.delay) + " came");
}

Sensor::Sensor(SensorSetup setup, const SensorModel& model, double dt)
    : setup_(std::move(setup)), model_(model), walk_(model.drift * std::sqrt(dt)) {
  require_sensor_model(setup_.name, model_);
  const auto size = static_cast<Index>(setup_.sources.size());
  truth_ = bias_ = reading_ = Vector::Zero(size);
  past_ = Matrix::Zero(model_.delay, size);
}

void Sensor::reset(const mjData* data, std::uint64_t seed) {
  random_ = Random(model_.ideal() ? 0 : seed);  // draws nothing: the same state for every seed
  read(data);
  for (double& bias : bias_) bias = model_.bias > 0.0 ? model_.bias * random_.normal() : 0.0;
  past_.rowwise() = truth_.transpose();
  next_ = 0;
  reading_ = truth_;
}

void Sensor::sample(const mjData* data) {
  read(data);
  if (model_.ideal()) {
    reading_ = truth_;
    return;
  }
  if (model_.delay > 0) {
    truth_.swap(past_.row(next_).transpose());
    next_ = (next_ + 1) % model_.delay;
  }
  for (Index i = 0; i < truth_.size(); ++i) {
    if (walk_ > 0.0) bias_[i] += walk_ * random_.normal();
    double value = truth_[i];
    if (model_.bias > 0.0 || walk_ > 0.0) value += bias_[i];
    if (model_.noise > 0.0) value += model_.noise * random_.normal();
    reading_[i] = round_off(value);
  }
}

void Sensor::read(const mjData* data) {
  for (std::size_t i = 0; i < setup_.sources.size(); ++i) {
    const SensorSource& source = setup_.sources[i];
    truth_[static_cast<Index>(i)] = source.scale * array_of(data, source.array)[source.address];
  }
}

double Sensor::round_off(double value) const {
  return model_.step > 0.0 ? model_.step * std::nearbyint(value / model_.step) : value;
}

void Sensor::save(StateWriter& writer) const {
  random_.save(writer);
  writer.put(bias_);
  writer.put(reading_);
  for (Index row = 0; row < past_.rows(); ++row) writer.put(past_.row(row).transpose());
  writer.put(static_cast<double>(next_));
}

void Sensor::restore(StateReader& reader) {
  random_.restore(reader);
  reader.get(bias_);
  for (double& value : reading_) value = reader.get_any();  // a broken sensor says NaN
  for (Index row = 0; row < past_.rows(); ++row) {
    for (double& value : past_.row(row)) value = reader.get();
  }
  next_ = reader.get_count(std::max(past_.rows() - 1, Index{0}));
}

}  // namespace hurcules
