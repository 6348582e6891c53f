#include "hurcules/tasks/stiffness_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

constexpr double kUnknown = 100.0;  // the first increment counts for 99 % of the estimate
constexpr double kLeast = 1e-3;     // what forgetting leaves is never nothing

}  // namespace

StiffnessEstimate::StiffnessEstimate(const StiffnessOptions& options) : options_(options) {
  require(options.lower > 0.0 && options.lower <= options.upper && std::isfinite(options.upper),
          "bounds of a stiffness want 0 < lower <= upper [N/m]");
  require(options.forgetting > 0.0 && options.forgetting <= 1.0, "forgetting wants 0 to 1");
  require(std::isfinite(options.step) && options.step > 0.0, "step wants a positive length [m]");
  start(0.0, 0.0);
}

void StiffnessEstimate::start(double position, double force) {
  value_ = options_.upper;
  covariance_ = kUnknown;
  position_ = position;
  force_ = force;
}

void StiffnessEstimate::look(double position, double force) {
  const double step = (position - position_) / options_.step;
  if (std::abs(step) < 1.0) return;
  const double gain = covariance_ * step / (options_.forgetting + step * covariance_ * step);
  const double wanted = force - force_ - value_ * step * options_.step;  // what G does not explain
  value_ = std::clamp(value_ + gain * wanted / options_.step, options_.lower, options_.upper);
  covariance_ = std::max((1.0 - gain * step) * covariance_ / options_.forgetting, kLeast);
  position_ = position;
  force_ = force;
}

void StiffnessEstimate::save(StateWriter& writer) const {
  for (const double value : {value_, covariance_, position_, force_}) writer.put(value);
}

void StiffnessEstimate::restore(StateReader& reader) {
  for (double* value : {&value_, &covariance_, &position_, &force_}) *value = reader.get();
}

}  // namespace hurcules
