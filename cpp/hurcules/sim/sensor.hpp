// One sensor: what it says about some numbers of the physics, with noise, bias, delay and steps.
//
//   y_k = Q(x_{k-d} + b + w_k + n_k),   w_k = w_{k-1} + drift sqrt(dt) g_k
//
// x truth, n white noise, b a bias drawn once, w one that walks, d the delay in samples, Q rounding
// to whole steps. With all of them zero y is x to the last bit. Errors of the entries of a sensor
// are independent, and each sensor has random numbers of its own: what one does changes no other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hurcules/base/random.hpp"
#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"

struct mjData_;

namespace hurcules {

// [unit] is the sensor's own
struct SensorModel {
  double noise = 0.0;  // [unit] standard deviation of each sample
  double bias = 0.0;   // [unit] standard deviation of a constant drawn at the start
  double drift = 0.0;  // [unit/sqrt(s)] of the walking bias: its standard deviation after 1 s
  int delay = 0;       // [samples], 0 to kMostDelay
  double step = 0.0;   // [unit] of the last bit, 0: as fine as a double

  static constexpr int kMostDelay = 1000;
  [[nodiscard]] bool ideal() const {
    return noise == 0.0 && bias == 0.0 && drift == 0.0 && delay == 0 && step == 0.0;
  }
};

// throws Error, which names the sensor, for a number below 0, not finite, or a delay out of range
void require_sensor_model(const std::string& sensor, const SensorModel& model);

// Where an entry finds its truth in mjData.
struct SensorSource {
  enum class Array { Position, Velocity, Sensor };  // qpos, qvel, sensordata
  Array array = Array::Position;
  int address = 0;
  double scale = 1.0;  // truth = scale * number
};

// What a sensor measures.
struct SensorSetup {
  std::string name, unit;
  std::vector<std::string> entries;   // (m)
  std::vector<SensorSource> sources;  // (m)
};

class Sensor {
 public:
  // dt [s] between samples
  Sensor(SensorSetup setup, const SensorModel& model, double dt);
  // draws the bias; before the first sample it says what is true now
  void reset(const mjData_* data, std::uint64_t seed);
  void sample(const mjData_* data);
  // a fault: one entry of the reading replaced
  void set_reading(Index entry, double value) { reading_[entry] = value; }

  [[nodiscard]] const SensorSetup& setup() const { return setup_; }
  [[nodiscard]] const SensorModel& model() const { return model_; }
  [[nodiscard]] Index size() const { return reading_.size(); }      // m
  [[nodiscard]] const Vector& reading() const { return reading_; }  // (m)
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void read(const mjData_* data);  // the truth into truth_
  [[nodiscard]] double round_off(double value) const;

  SensorSetup setup_;
  SensorModel model_;
  double walk_;  // [unit] drift sqrt(dt)
  Random random_;
  Vector truth_, bias_, reading_;  // (m)
  Matrix past_;                    // (delay, m): truths of the last samples, a ring
  Index next_ = 0;                 // row of the oldest
};

}  // namespace hurcules
