#include "hurcules/control/force_readings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"

namespace hurcules {

void ForceReadings::add(ForceTask& task, std::unique_ptr<SpringForce> spring) {
  readings_.push_back({&task, std::move(spring), -1, 1.0, {}});
}

void ForceReadings::add(ForceTask& task, int sensor_row, double sign, std::optional<Frame> site) {
  constexpr double kFilter = 3e-3;  // [s]
  require(
      std::isfinite(sign) && sign != 0.0,
      "the sign of a sensor wants a finite number other than 0, " + number_text(sign) + " came");
  task.set_filter(kFilter);
  readings_.push_back({&task, nullptr, sensor_row, sign, site});
}

ForceReadings ForceReadings::of(const std::function<ForceTask*(ForceTask&)>& task) const {
  ForceReadings copy = *this;
  for (Reading& reading : copy.readings_) {
    reading.task = task(*reading.task);
    if (reading.spring) reading.spring = std::make_shared<SpringForce>(*reading.spring);
  }
  return copy;
}

void ForceReadings::tell(const Robot& robot, const Vector& qpos, const Vector& qvel,
                         const double* sensors) const {
  for (const Reading& reading : readings_) {
    double force = 0.0;
    if (reading.spring) {
      force = of_spring(reading, qpos, qvel);
    } else if (sensors) {
      force = of_sensors(reading, robot, sensors);
    }
    reading.task->sense(robot, force);
  }
}

// the force along the axis that bends it so
double ForceReadings::of_spring(const Reading& reading, const Vector& qpos, const Vector& qvel) {
  reading.spring->update(qpos, qvel);
  return -reading.spring->force() / reading.spring->direction().dot(reading.task->options().axis);
}

double ForceReadings::of_sensors(const Reading& reading, const Robot& robot,
                                 const double* sensors) {
  if (!reading.site) return reading.sign * sensors[reading.row];
  const Eigen::Map<const Vector3> force(sensors + reading.row);
  return reading.sign * reading.task->world_axis(robot).dot(robot.pose(*reading.site).R * force);
}

bool ForceReadings::want_sensors() const {
  return std::any_of(readings_.begin(), readings_.end(),
                     [](const Reading& reading) { return !reading.spring; });
}

bool ForceReadings::feed(const ForceTask& task) const {
  return std::any_of(readings_.begin(), readings_.end(),
                     [&task](const Reading& reading) { return reading.task == &task; });
}

}  // namespace hurcules
