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

void set_ranges(JointLimits& limits, const std::vector<ModeRange>& ranges) {
  for (const ModeRange& range : ranges)
    limits.set_range(range.coordinate, range.lower, range.upper);
}

}  // namespace hurcules
