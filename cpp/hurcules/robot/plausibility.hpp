// What is probably not meant about the limits of a robot: for a warning to who has just loaded or placed it.
#pragma once

#include <string>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

// Hinges whose range looks as if radians were read as degrees (all of it within 2 pi degrees) or degrees as radians
// (more than two turns either way); "" for none.
[[nodiscard]] std::string implausible_ranges(const Robot& robot);

// Coordinates that stand outside their limits by more than 0.001 rad or m; "" for none.
[[nodiscard]] std::string outside_limits(const Robot& robot);

// Loops of the model's constraints that cannot close at this configuration; "" for none.
[[nodiscard]] std::string open_loops(const Robot& robot);

}  // namespace hurcules
