// Force control of one direction as a law: from force error to velocity or acceleration [T
// §5.4, 5.7].
//
//   environment   f = G (s - r)   what the robot exerts on it along the axis        [T 5.4.27]
//   FirstOrder        ds/dt = C (f_d - f)                                           [T 5.7.62]
//   Velocity          M d2s/dt2 = -L ds/dt + K delta                                [T 5.4.35]
//   Position          M d2s/dt2 = -L ds/dt + K (delta - s),  delta = C (f_d - f)    [T 5.4.28-29]
//   PositionIntegral  the same with  delta = C (f_d - f) + N int (f_d - f) dt       [T 5.4.34]
// s counts from the motion reference. In the steady state f = f_d, but with Position
//     f = (C G f_d - G r) / (1 + C G)                                               [T 5.4.33]
#pragma once

#include <string>

#include "hurcules/base/state.hpp"

namespace hurcules {

enum class ForceLoop { FirstOrder, Velocity, Position, PositionIntegral };

struct ForceGains {
  ForceLoop loop = ForceLoop::FirstOrder;
  double compliance = 1e-3;  // C > 0: [m/s/N] of FirstOrder, [m/N] of the others
  double integral = 0.0;     // [m/s/N] N > 0, of PositionIntegral alone
  double mass = 1.0;         // [kg] M > 0, as are [kg/s] L and [kg/s^2] K; not of FirstOrder
  double damping = 20.0;     // L
  double stiffness = 100.0;  // K
  double dt = 1e-3;          // [s]
};

// [N/m] Largest G that the loop keeps stable in steps of dt, with a reading that is one step old
// and a robot that follows exactly; C G dt < 1 for FirstOrder. A real servo asks for less: C G well
// below its bandwidth [T §5.7.2].
[[nodiscard]] double largest_stiffness(const ForceGains& gains);

// throws Error, naming the task, for gains that cannot be, and for an environment that these gains
// do not keep stable, with the largest one that they do; `environment` [N/m], 0 for unknown
void check_force_gains(const ForceGains& gains, double environment, const std::string& task);

class ForceLaw {
 public:
  explicit ForceLaw(const ForceGains& gains) : gains_(gains) {}

  struct Motion {
    double position = 0.0;  // [m] s, from the motion reference
    double velocity = 0.0;  // [m/s] ds/dt, from that of the reference
  };
  // velocity [m/s] of FirstOrder, else acceleration [m/s^2], at the force error f_d - f [N]; with
  // the compliance C times `share`, 0 to 1
  [[nodiscard]] double step(const Motion& motion, double force_error, double share);
  // what the same law asks for without contact: the reference alone; zero for FirstOrder
  [[nodiscard]] double free(const Motion& motion) const;
  [[nodiscard]] bool commands_acceleration() const { return gains_.loop != ForceLoop::FirstOrder; }
  // the reference takes part in the law while in contact
  [[nodiscard]] bool has_reference() const {
    return gains_.loop == ForceLoop::Position || gains_.loop == ForceLoop::PositionIntegral;
  }
  // [1/s] at which a force error of an environment G would vanish
  [[nodiscard]] double rate(double environment) const;
  [[nodiscard]] const ForceGains& gains() const { return gains_; }
  void reset() { integral_ = 0.0; }
  void save(StateWriter& writer) const { writer.put(integral_); }
  void restore(StateReader& reader) { integral_ = reader.get(); }

 private:
  ForceGains gains_;
  double integral_ = 0.0;  // [N s]
};

}  // namespace hurcules
