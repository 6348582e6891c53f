#include "hurcules/sim/battery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

}  // namespace

Battery::Battery(const BatteryOptions& options) : options_(options), energy_(options.capacity) {
  require_number(positive(options.capacity), "a battery wants a capacity above 0 [J]",
                 options.capacity);
  require_number(positive(options.voltage), "a battery wants a voltage above 0 [V]",
                 options.voltage);
  require_number(std::isfinite(options.resistance) && options.resistance >= 0.0,
                 "a battery wants a resistance >= 0 [Ohm]", options.resistance);
}

double Battery::max_power() const {
  if (options_.resistance <= 0.0) return std::numeric_limits<double>::infinity();
  return options_.voltage * options_.voltage / (4.0 * options_.resistance);
}

// the smaller root of I U_0 - I^2 R = P, in the form that has no difference of near numbers
double Battery::current(double power) const {
  const double U = options_.voltage, load = std::min(power, max_power());
  const double root = std::sqrt(std::max(U * U - 4.0 * options_.resistance * load, 0.0));
  return 2.0 * load / (U + root);
}

void Battery::draw(double power, double seconds) {
  const double I = current(power);
  const double heat = I * I * options_.resistance * seconds;
  const double taken = std::min(I * options_.voltage * seconds, energy_);
  if (energy_ - taken > options_.capacity) return;  // full: the charger is off
  energy_ -= taken;
  const double warmed = taken > 0.0 ? std::min(heat, taken) : heat;
  lost_ += warmed;
  delivered_ += taken - warmed;
}

void Battery::reset() {
  energy_ = options_.capacity;
  delivered_ = lost_ = 0.0;
}

void Battery::save(StateWriter& writer) const {
  for (const double value : {energy_, delivered_, lost_}) writer.put(value);
}

void Battery::restore(StateReader& reader) {
  for (double* value : {&energy_, &delivered_, &lost_}) *value = reader.get();
}

}  // namespace hurcules
