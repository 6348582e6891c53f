// Magnetic brakes in the joint drives: a spring closes them, power opens them [T §4.2.3].
//
// A brake is dry friction at the joint: it carries any load up to its torque at no power, and slips
// above. A physics step writes its torque into the friction row of its joint, between mj_step1 and
// mj_step2, so that model data stay as they are and the brake needs no angle to lock at: it closes
// where the joint is. With the stiff solimpfriction of common/classes.xml it creeps by about
// 1e-6 rad/s under load. A brake closes and opens over `time`; the motor rests only once it is
// shut, and takes the load over before it opens (Servo::mind), so that nothing jumps.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

struct BrakeOptions {
  double strength = 1.2;     // brake torque over the peak torque of the motor
  double time = 0.05;        // [s] from open to shut and back
  double coil_power = 12.0;  // [W] that holds one brake open
};

class Brakes {
 public:
  // A brake at every actuator of a joint with a forcerange and a friction row (frictionloss above
  // 0 in the model), all open. Throws Error for options out of range.
  explicit Brakes(const mjModel_* model, const BrakeOptions& options = {});

  // the actuator of a joint with a brake; throws Error with the names that exist
  [[nodiscard]] int find(const std::string& joint) const;
  [[nodiscard]] std::vector<std::string> names() const;  // of the joints with a brake
  void set_closed(int actuator, bool closed);            // throws Error where there is no brake
  void close();                                          // all of them
  // all at once and at once shut or open: for a start
  void reset(bool closed = false);

  // between mj_step1 and mj_step2, and after mj_step2
  void tighten(mjData_* data) const;
  void advance(const mjData_* data);

  [[nodiscard]] bool exists(int actuator) const { return brake(actuator).torque > 0.0; }
  [[nodiscard]] bool is_shut(int actuator) const { return grip_[actuator] >= 1.0; }
  [[nodiscard]] bool is_open(int actuator) const { return grip_[actuator] <= 0.0; }
  [[nodiscard]] bool any_shut() const { return (grip_.array() > 0.0).any(); }  // or half shut
  // [N m] or [N] that the brake (and the friction of its joint) bore in the last step, in the
  // joint's direction: a motor that gives it instead keeps the joint still
  [[nodiscard]] double load(int actuator) const { return load_[actuator]; }
  [[nodiscard]] double max_load(int actuator) const { return brake(actuator).torque; }
  [[nodiscard]] double power() const;  // [W] of the coils of all that are not to be closed
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Brake {
    std::string joint;
    int dof = -1;
    double torque = 0.0;  // [N m] or [N]; 0: no brake
  };
  [[nodiscard]] const Brake& brake(int actuator) const {
    return brakes_[static_cast<std::size_t>(actuator)];
  }

  BrakeOptions options_;
  double dt_;
  std::vector<Brake> brakes_;      // (nu)
  std::vector<int> brake_of_dof_;  // (nv), -1 for none
  std::vector<bool> closed_;       // (nu) as commanded
  Vector grip_, load_;             // (nu): 0 open to 1 shut; [N m]
};

}  // namespace hurcules
