// Typical sensors of such a robot, with noise, bias, delay and resolution.
//
// The thesis names the sensors (LIDAR, cameras, IMU, GPS, encoders) but no types and no figures. All
// numbers are assumptions after common data sheets, with the reason beside each.
#pragma once

#include "hurcules/sim/sensors.hpp"

namespace hurcules {

[[nodiscard]] SensorOptions realistic_sensors();
// those of them that this robot has
[[nodiscard]] SensorOptions realistic_sensors(const Robot& robot);

}  // namespace hurcules
