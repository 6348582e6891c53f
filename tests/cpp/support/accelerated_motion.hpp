// A robot that follows an acceleration controller exactly.
#pragma once

#include "hurcules/control/acceleration_controller.hpp"

namespace hurcules_test {

// on by a period with the acceleration of the last solve; where it is then -> q and v (n)
inline void follow(const hurcules::AccelerationController& controller, hurcules::Robot& robot,
                   hurcules::Vector& q, hurcules::Vector& v) {
  q = robot.configuration();
  v = robot.velocity();
  controller.integrate(q, v);
  robot.set_configuration(q);
  robot.set_velocity(v);
}

}  // namespace hurcules_test
