#include "hurcules/mission/robot_tables.hpp"

#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

// what differs between the modes: how far knee and hip may go
struct LegRanges {
  ModeRange knee, hip;
};

std::vector<ModeRange> ready_ranges(const LegRanges& legs) {
  return {
      legs.knee,
      legs.hip,
      {"LSP", -0.35, 2.58},  // backpack
      {"LSR", -0.02, 1.20},  //
      {"LSY", -1.20, 1.20},  //
      {"LEB", 0.00, 2.48},   //
      {"RSP", -0.35, 2.58},  //
      {"RSR", -0.02, 1.20},  //
      {"RSY", -1.20, 1.20},  //
      {"REB", 0.00, 2.48},
  };
}

std::vector<ServoGains> both_arms(const std::vector<ServoGains>& arm) {
  std::vector<ServoGains> rows;
  for (const ServoGains& row : arm) {
    rows.push_back({"L" + row.joint, row.inertia, row.bandwidth});
    rows.push_back({"R" + row.joint, row.inertia, row.bandwidth});
  }
  return rows;
}

// Lower body, trunk and neck of both robots. The drives brake: half the robot, 340 kg x (0.14 m)^2,
// hangs on each belt.
std::vector<ServoGains> with_body(std::vector<ServoGains> arms) {
  std::vector<ServoGains> rows = {
      {"LKN", 280.0, 20.0}, {"RKN", 280.0, 20.0}, {"HIP", 240.0, 20.0},
      {"WST", 26.0, 20.0},  {"NKY", 0.27, 60.0},  {"NKP", 0.30, 60.0},
  };
  rows.insert(rows.end(), arms.begin(), arms.end());
  rows.push_back({"L_lower_belt", 7.0, 20.0});
  rows.push_back({"R_lower_belt", 7.0, 20.0});
  return rows;
}

}  // namespace

const std::vector<ModeRange>& rescue_ready_ranges() {
  // knee: the bed would meet the ground at 0.94; hip: 0.69 before the trunk meets the bed
  static const auto ranges = ready_ranges({{"KN", 1.00, 2.20}, {"HIP", -2.00, 0.36}});
  return ranges;
}

// the same distances: the battery would meet the ground at 0.64, the torso the battery at 1.40
const std::vector<ModeRange>& rescue_without_bed_ranges() {
  static const auto ranges = ready_ranges({{"KN", 0.70, 2.20}, {"HIP", -2.00, 0.71}});
  return ranges;
}

const std::vector<ModeRange>& ranges_of_mode(const std::string& mode) {
  if (mode == "rescue_ready") return rescue_ready_ranges();
  if (mode == "rescue_ready_without_bed") return rescue_without_bed_ranges();
  throw Error(unknown_name("mode", mode, {"rescue_ready", "rescue_ready_without_bed"}));
}

// Inertia: the largest over the stretch with all other joints rigid, rotor included, half of the
// knees' each (a test compares it with the model). Bandwidth: high enough that a reversal of the
// joint's dry friction f bends it by less than 2 mrad, 0.54 f / (J omega^2), and at least 20 rad/s.
// A triple pole stays stable up to nine times the inertia that it was made for: the arms may take
// 120 kg.
const std::vector<ServoGains>& rescue_servo() {
  static const std::vector<ServoGains> rows = [] {
    std::vector<ServoGains> all = with_body(
        both_arms({{"SP", 10.0, 30.0}, {"SR", 10.0, 30.0}, {"SY", 2.5, 40.0}, {"EB", 2.5, 50.0}}));
    // the bed [kg]: its own 23, the screws, and a person on it
    all.push_back({"bed_lift", 200.0, 20.0});
    all.push_back({"L_bed_1", 30.0, 20.0});
    all.push_back({"R_bed_1", 30.0, 20.0});
    return all;
  }();
  return rows;
}

// Inertia as above, in the acquisition posture.
const std::vector<ServoGains>& manipulation_servo() {
  static const std::vector<ServoGains> rows = [] {
    std::vector<ServoGains> all = with_body(both_arms({{"SP", 11.0, 30.0},
                                                       {"SR", 11.0, 30.0},
                                                       {"SY", 2.5, 40.0},
                                                       {"EB", 3.0, 50.0},
                                                       {"WY", 0.18, 60.0},
                                                       {"WP", 0.30, 60.0},
                                                       {"WY2", 0.11, 60.0}}));
    // fingers [kg]: two of them and the spindle
    all.push_back({"L_grip_1", 4.6, 30.0});
    all.push_back({"R_grip_1", 4.6, 30.0});
    return all;
  }();
  return rows;
}

const std::vector<ServoGains>& servo_of_robot(const std::string& robot) {
  if (robot == "rescue") return rescue_servo();
  if (robot == "manipulation") return manipulation_servo();
  throw Error(unknown_name("robot", robot, {"manipulation", "rescue"}));
}

void set_ranges(JointLimits& limits, const std::vector<ModeRange>& ranges) {
  for (const ModeRange& range : ranges)
    limits.set_range(range.coordinate, range.lower, range.upper);
}

}  // namespace hurcules
