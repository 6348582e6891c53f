#include "hurcules/sim/fall_monitor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace hurcules {

void FallMonitor::reset(const Matrix3& R_support) {
  up_ = R_support.transpose() * Vector3::UnitZ();
}

double FallMonitor::tilt(const Matrix3& R_support) const {
  return std::acos(std::clamp((R_support * up_).z(), -1.0, 1.0));
}

double FallMonitor::height(const Matrix3& R_support, const Vector3& place) const {
  return (R_support * up_).dot(place);
}

std::string FallMonitor::text(const Matrix3& R_support, double height) const {
  std::array<char, 96> text{};
  if (height < limits_.min_height) {
    std::snprintf(text.data(), text.size(), "%.3f m high, at least %g", height, limits_.min_height);
  } else {
    std::snprintf(text.data(), text.size(), "tilted by %.3f rad, at most %g", tilt(R_support),
                  limits_.max_tilt);
  }
  return text.data();
}

bool FallMonitor::fell(const Matrix3& R_support, double height) const {
  return height < limits_.min_height || tilt(R_support) > limits_.max_tilt;
}

void FallMonitor::save(StateWriter& writer) const {
  writer.put(up_);
}

void FallMonitor::restore(StateReader& reader) {
  for (double& value : up_) value = reader.get();
}

}  // namespace hurcules
