#include "hurcules/mission/robot_tables.hpp"

namespace hurcules {

const std::vector<ModeRange>& rescue_ready_ranges() {
  static const std::vector<ModeRange> ranges = {
      {"KN", 1.00, 2.20},    // the bed would meet the ground above 2.2
      {"HIP", -2.00, 0.36},  // battery against torso
      {"LSP", -0.35, 2.58},  // backpack
      {"LSR", -0.02, 1.20},  //
      {"LSY", -1.20, 1.20},  //
      {"LEB", 0.00, 2.48},   //
      {"RSP", -0.35, 2.58},  //
      {"RSR", -0.02, 1.20},  //
      {"RSY", -1.20, 1.20},  //
      {"REB", 0.00, 2.48},
  };
  return ranges;
}

// Inertia: the largest over the stretch with all other joints rigid, rotor included, half of the
// knees' each (a test compares it with the model). Bandwidth: high enough that a reversal of the
// joint's dry friction f bends it by less than 2 mrad, 0.54 f / (J omega^2), and at least 20 rad/s.
// A triple pole stays stable up to nine times the inertia that it was made for: the arms may take
// 120 kg.
const std::vector<ServoRow>& rescue_servo() {
  static const std::vector<ServoRow> rows = {
      {"LKN", 280.0, 20.0},
      {"RKN", 280.0, 20.0},
      {"HIP", 240.0, 20.0},
      {"WST", 26.0, 20.0},
      {"NKY", 0.27, 60.0},
      {"NKP", 0.30, 60.0},
      {"LSP", 10.0, 30.0},
      {"RSP", 10.0, 30.0},
      {"LSR", 10.0, 30.0},
      {"RSR", 10.0, 30.0},
      {"LSY", 2.5, 40.0},
      {"RSY", 2.5, 40.0},
      {"LEB", 2.5, 50.0},
      {"REB", 2.5, 50.0},
      // the drives brake: half the robot, 340 kg x (0.14 m)^2, hangs on each belt
      {"L_lower_belt", 7.0, 20.0},
      {"R_lower_belt", 7.0, 20.0},
  };
  return rows;
}

void set_ranges(JointLimits& limits, const std::vector<ModeRange>& ranges) {
  for (const ModeRange& range : ranges)
    limits.set_range(range.coordinate, range.lower, range.upper);
}

}  // namespace hurcules
