#include "hurcules/sim/sensor_monitor.hpp"

#include <cmath>
#include <utility>

namespace hurcules {

SensorMonitor::SensorMonitor(std::vector<EncoderReference> references, double dt,
                             const SensorMonitorOptions& options)
    : references_(std::move(references)), dt_(dt), options_(options) {
  const auto size = static_cast<Index>(references_.size());
  last_ = reference_at_change_ = window_start_ = way_ = Vector::Zero(size);
}

void SensorMonitor::reset() {
  begun_ = false;
  ticks_ = 0;
  for (Vector* values : {&last_, &reference_at_change_, &window_start_, &way_}) values->setZero();
}

double SensorMonitor::reference(std::size_t entry, const Vector& q_des) const {
  const EncoderReference& found = references_[entry];
  return found.coordinate < 0 ? 0.0 : found.factor * q_des[found.coordinate];
}

SensorMonitor::Finding SensorMonitor::look(const Vector& position, const Vector& speed,
                                           const Vector& q_des) {
  const bool window_over = begun_ && ++ticks_ >= options_.window;
  for (std::size_t k = 0; k < references_.size(); ++k) {
    const auto i = static_cast<Index>(k);
    if (!std::isfinite(position[i])) return {Trouble::NotANumber, i, false};
    if (!std::isfinite(speed[i])) return {Trouble::NotANumber, i, true};
    const double target = reference(k, q_des);
    if (!begun_ || position[i] != last_[i]) {
      last_[i] = position[i];
      reference_at_change_[i] = target;
    }
    if (std::abs(target - reference_at_change_[i]) > options_.tolerance) {
      return {Trouble::Stuck, i, false};
    }
    way_[i] = begun_ ? way_[i] + dt_ * speed[i] : 0.0;
    if (!begun_) window_start_[i] = position[i];
    if (!window_over) continue;
    const double gap = std::abs(position[i] - window_start_[i] - way_[i]);
    if (gap > options_.tolerance + options_.share * std::abs(way_[i])) {
      return {Trouble::Disagrees, i, false};
    }
    window_start_[i] = position[i];
    way_[i] = 0.0;
  }
  if (window_over) ticks_ = 0;
  begun_ = true;
  return {};
}

void SensorMonitor::save(StateWriter& writer) const {
  writer.put(begun_ ? 1.0 : 0.0);
  writer.put(static_cast<double>(ticks_));
  for (const Vector* values : {&last_, &reference_at_change_, &window_start_, &way_}) {
    writer.put(*values);
  }
}

void SensorMonitor::restore(StateReader& reader) {
  begun_ = reader.get_count(1) > 0;
  ticks_ = static_cast<int>(reader.get_count(options_.window));
  for (Vector* values : {&last_, &reference_at_change_, &window_start_, &way_}) {
    reader.get(*values);
  }
}

}  // namespace hurcules
