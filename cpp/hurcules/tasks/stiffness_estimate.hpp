// How stiff an environment is, learnt while a hand presses on it: recursive least squares on
// increments, with forgetting and bounds.
//
//   df = G ds     ds, df since the last increment that was long enough to tell
// The commanded position is taken, not the measured one: G then holds the give of the robot too,
// and that is what the force loop feels. Between long increments it learns nothing and forgets
// nothing.
#pragma once

#include "hurcules/base/state.hpp"

namespace hurcules {

struct StiffnessOptions {
  double lower = 100.0;     // [N/m] bounds of the estimate
  double upper = 1e6;       // [N/m] what it starts from: careful until it knows better
  double forgetting = 0.9;  // of an increment, 0 to 1
  double step = 5e-5;       // [m] shortest increment
};

class StiffnessEstimate {
 public:
  // throws Error
  explicit StiffnessEstimate(const StiffnessOptions& options);
  // contact began
  void start(double position, double force);  // [m], [N]
  void look(double position, double force);
  [[nodiscard]] double value() const { return value_; }  // [N/m]
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  StiffnessOptions options_;
  double value_ = 0.0;
  double covariance_ = 0.0;  // in units of 1 / step^2
  double position_ = 0.0, force_ = 0.0;
};

}  // namespace hurcules
