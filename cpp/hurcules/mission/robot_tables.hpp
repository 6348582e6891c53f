// What is known about Hurcules in numbers, beside its model: the ranges of its modes.
#pragma once

#include <string>
#include <vector>

#include "hurcules/control/tasks.hpp"

namespace hurcules {

// A range of a coordinate in a mode of work: narrower than the hardware's.
struct ModeRange {
  std::string coordinate;
  double lower = 0.0;  // [rad]
  double upper = 0.0;  // [rad]
};

// Rescue-ready: battery and transfer bed limit hip and knee, the backpack the shoulders [T §4.4].
[[nodiscard]] const std::vector<ModeRange>& rescue_ready_ranges();
// The same with the bed detached: the battery alone limits hip and knee.
[[nodiscard]] const std::vector<ModeRange>& rescue_without_bed_ranges();
// The ranges of a mode: "rescue_ready", "rescue_ready_without_bed". Throws Error with the names.
[[nodiscard]] const std::vector<ModeRange>& ranges_of_mode(const std::string& mode);

void set_ranges(JointLimits& limits, const std::vector<ModeRange>& ranges);

}  // namespace hurcules
