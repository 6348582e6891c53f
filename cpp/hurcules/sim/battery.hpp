// The battery: an ideal voltage behind a resistance, from which power is drawn until its energy is
// used up.
//
//   P = I U_0 - I^2 R,   dE/dt = -I U_0: what the load gets and what warms the battery
//
// The largest power is U_0^2 / (4 R). The energy never grows beyond full.
#pragma once

#include "hurcules/base/state.hpp"

namespace hurcules {

// Assumed: 60 kg at 130 W h/kg, of which 80 % are used (docs/design/robot.md#battery).
struct BatteryOptions {
  double capacity = 6.2 * 3.6e6;  // [J] that can be used
  double voltage = 96.0;          // [V] without load
  double resistance = 0.05;       // [Ohm]
};

class Battery {
 public:
  // throws Error for a capacity or voltage that is not above 0, or a resistance below 0
  explicit Battery(const BatteryOptions& options = {});
  // `power` [W] for `seconds`; negative charges. What is beyond the largest power is not there.
  void draw(double power, double seconds);
  void reset();  // full

  [[nodiscard]] double current(double power) const;              // [A] at this load
  [[nodiscard]] double max_power() const;                        // [W]
  [[nodiscard]] double energy() const { return energy_; }        // [J] left
  [[nodiscard]] double delivered() const { return delivered_; }  // [J] to the load since reset
  [[nodiscard]] double lost() const { return lost_; }            // [J] in its own resistance
  [[nodiscard]] double charge() const { return energy_ / options_.capacity; }  // 0 to 1
  [[nodiscard]] bool empty() const { return energy_ <= 0.0; }
  [[nodiscard]] const BatteryOptions& options() const { return options_; }
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  BatteryOptions options_;
  double energy_ = 0.0, delivered_ = 0.0, lost_ = 0.0;
};

}  // namespace hurcules
