// How long each stage of a tick takes, by a clock from outside; without one it costs nothing.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

// Problem is the making of the hierarchy
enum class Stage { Sense, Kinematics, Problem, Solve, Servo, Physics, Record };
inline constexpr Index kStages = 7;
[[nodiscard]] inline const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names = {"sense", "kinematics", "hierarchy", "solve",
                                                 "servo", "physics",    "record"};
  return names;
}

using Clock = double (*)();  // [s]

class StageTimer {
 public:
  StageTimer(Clock clock, Vector& seconds) : clock_(clock), seconds_(seconds) {
    if (clock_) last_ = clock_();
  }
  // all since the last call, or since the start, was this stage
  void done(Stage stage) {
    if (!clock_) return;
    const double now = clock_();
    seconds_[static_cast<Index>(stage)] = now - last_;
    last_ = now;
  }

 private:
  Clock clock_;
  Vector& seconds_;  // [s], (kStages)
  double last_ = 0.0;
};

}  // namespace hurcules
