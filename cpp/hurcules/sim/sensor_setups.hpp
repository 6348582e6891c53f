// The sensors of a robot, found in its model by name and kind.
//
//   encoder_position, encoder_speed   joints with a motor: [rad], [rad/s] (slides [m], [m/s])
//   imu_acceleration, imu_rate        the model's accelerometer and gyro of that name: [m/s^2],
//                                     [rad/s] in the frame of their site, gravity included
//   load                              contact sensors of the robot's bodies: force [N] on what the
//                                     body touches, world axes
//   track_speed                       surface speed of each belt [m/s]
//   pose_position, pose_rotation      root of the robot in the world: [m]; quaternion w x y z
//   pose_velocity, pose_rate          [m/s] in world axes; [rad/s] in those of the root
//
// Sensors of the model (imu_*, load) speak of the step that has just been taken: they are one tick
// older than encoders and pose.
#pragma once

#include <string>
#include <vector>

#include "hurcules/sim/sensor.hpp"

struct mjModel_;

namespace hurcules {

inline constexpr const char* kEncoderPosition = "encoder_position";
inline constexpr const char* kEncoderSpeed = "encoder_speed";
inline constexpr const char* kPoseRotation = "pose_rotation";

// those that the model has, of the robot whose trees begin at these bodies; its pose is the first's
[[nodiscard]] std::vector<SensorSetup> find_sensors(const mjModel_* model,
                                                    const std::vector<int>& robot_roots);
// joint ids in the order of the encoders' entries
[[nodiscard]] std::vector<int> encoder_joints(const mjModel_* model,
                                              const std::vector<int>& robot_roots);

}  // namespace hurcules
