// What a task asks for changes no faster than its max_acceleration.
//
//   y <- y_last + (y - y_last) min(1, a dt / |y - y_last|)      y without what is fed forward
// y_last: what was asked for in the last period, but no further from J qdot than the task gets in 0.2 s:
// it runs away from no robot that is held. At first J qdot, and of rows that ask for nothing. Of an
// interval the side that pushes is bounded.
#pragma once

#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/control/stack.hpp"

namespace hurcules {

class RateChanges {
 public:
  void set_stack(const Stack& stack);  // makes the memory; nothing was asked for before
  void forget();                       // the same of the stack that it has
  // of the i-th task of level k: both sides (m) [unit/s] of what it asks for in this period, at the
  // velocity of the coordinates (n)
  void limit(std::size_t k, std::size_t i, const Task& task, const Vector& velocity, double dt,
             VectorRef lower, VectorRef upper);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Asked {
    Vector rate;  // (m)
    bool known = false;
  };
  std::vector<std::vector<Asked>> last_;  // of each task of each level
  Vector change_, goes_;                  // scratch
};

}  // namespace hurcules
