#include "hurcules/tasks/tare.hpp"

#include <cmath>

namespace hurcules {

void Tare::begin(double readings) {
  size_ = readings;
  left_ = size_ + 1.0;  // the next reading may be of before: at a start there was none
  sum_ = 0.0;
}

void Tare::restart() {
  if (begins()) at_start_ = size_;
  zero_ = sum_ = 0.0;
  size_ = at_start_;
  left_ = at_start_ > 0.0 ? at_start_ + 1.0 : 0.0;
}

double Tare::off(double reading) {
  if (!runs() || !std::isfinite(reading)) return reading - zero_;
  if (!begins()) {
    sum_ += reading;
    zero_ = sum_ / (size_ - left_ + 1.0);
  }
  left_ -= 1.0;
  return 0.0;
}

void Tare::save(StateWriter& writer) const {
  for (const double value : {zero_, sum_, left_, size_}) writer.put(value);
}

void Tare::restore(StateReader& reader) {
  for (double* value : {&zero_, &sum_, &left_, &size_}) *value = reader.get();
}

}  // namespace hurcules
