#include "hurcules/sim/fall_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

void FallMonitor::reset(const Matrix3& R_support) {
  up_ = R_support.transpose() * Vector3::UnitZ();
}

double FallMonitor::tilt(const Matrix3& R_support) const {
  return std::acos(std::clamp((R_support * up_).z(), -1.0, 1.0));
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
