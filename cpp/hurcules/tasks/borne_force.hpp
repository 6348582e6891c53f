// What torques bear of a contact under force control [N], in place of the reading f:
//
//   b + m,   T db/dt = f_d - b,   dm/dt = N (f_d - f) from b = f_d on,   T the blend, N = 5 1/s
// What the model of a robot misses is then not magnified into a force that is missing, and friction
// beside the axis is no error of the force. b begins with the first reading, between 0 and f_d: an
// impact is not pushed on. Below half of what has been pressed, or of f_d, all of it fades with the
// reading: air bears nothing, and a tool behind the sensor that is thrown reads as if it pressed.
#pragma once

#include "hurcules/base/state.hpp"

namespace hurcules {

class BorneForce {
 public:
  // T > 0 [s], control period [s]; without the integral where a law keeps a force of its own
  BorneForce(double blend, double dt, bool integrates)
      : blend_(blend), dt_(dt), integrates_(integrates) {}

  void begin(double reading, double wanted);
  // one period; `least`: [N] that a wanted force counts as, at least
  void go_on(double reading, double wanted, double least);
  // at a reading; `release`: [N] where a contact ends
  [[nodiscard]] double value(double reading, double wanted, double release) const;
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  double blend_, dt_;
  bool integrates_;
  double led_ = 0.0;     // [N] b
  double missed_ = 0.0;  // [N] m
  double most_ = 0.0;    // [N] pressed so far
};

}  // namespace hurcules
