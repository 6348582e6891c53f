// One phase of a mission: which stack rules, what happens at its start, who commands, and when it
// is over.
#pragma once

#include <functional>
#include <string>

#include "hurcules/base/types.hpp"

namespace hurcules {

struct Phase {
  std::string name;
  std::string stack;  // of the controller
  // once, before its first tick at this time [s]
  std::function<void(double time)> enter;
  // each tick of dt [s]: what the operator commands, (k), in [m/s] or [rad/s]; it comes in as zero
  std::function<void(VectorRef command, double dt)> operate;
  // each tick, before anything else: true ends the phase; elapsed [s] since its start
  std::function<bool(double elapsed)> done;
};

}  // namespace hurcules
