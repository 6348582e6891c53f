#include "hurcules/tasks/borne_force.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

namespace {

double pressed(double reading, double wanted) {
  return wanted < 0.0 ? -reading : reading;
}

}  // namespace

void BorneForce::begin(double reading, double wanted) {
  led_ = std::clamp(reading, std::min(wanted, 0.0), std::max(wanted, 0.0));
  missed_ = 0.0;
  most_ = pressed(reading, wanted);
}

void BorneForce::go_on(double reading, double wanted, double least) {
  constexpr double kIntegral = 5.0, kNear = 0.02;  // [1/s], of the wanted force
  most_ = std::max(most_, pressed(reading, wanted));
  led_ += std::min(1.0, dt_ / blend_) * (wanted - led_);
  const double most = std::max(std::abs(wanted), least);
  if (!integrates_ || std::abs(wanted - led_) > kNear * most) return;
  missed_ = std::clamp(missed_ + kIntegral * dt_ * (wanted - reading), -most, most);
}

double BorneForce::value(double reading, double wanted, double release) const {
  const double fades = std::max(0.5 * std::min(std::abs(wanted), most_), release);
  return std::clamp(pressed(reading, wanted) / fades, 0.0, 1.0) * (led_ + missed_);
}

void BorneForce::save(StateWriter& writer) const {
  for (const double value : {led_, missed_, most_}) writer.put(value);
}

void BorneForce::restore(StateReader& reader) {
  for (double* value : {&led_, &missed_, &most_}) *value = reader.get();
}

}  // namespace hurcules
