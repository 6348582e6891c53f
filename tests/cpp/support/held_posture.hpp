// A servo that holds the coordinates of a plant at a place.
#pragma once

#include <mujoco/mujoco.h>

#include "hurcules/control/joint_servo.hpp"
#include "hurcules/sim/plant.hpp"

namespace hurcules_test {

// one control period: writes the plant's controls
inline void hold_posture(hurcules::JointServo& servo, hurcules::Plant& plant,
                         const hurcules::Vector& place) {
  using hurcules::Vector;
  const Vector qpos = std::as_const(plant).qpos(), qvel = std::as_const(plant).qvel();
  servo.follow(place, Vector::Zero(place.size()));
  servo.compute({qpos, qvel, plant.actuators()},
                Eigen::Map<Vector>(plant.data()->ctrl, plant.model()->nu));
}

}  // namespace hurcules_test
