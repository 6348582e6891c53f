// What a task asks of its rows, no faster than its max_speed.
//
//   g = side - e where that side pushes, 0 inside the interval       (m), unit
//   y = ds_des/dt + K g min(1, v / (K |g|)),   v = max_speed         [T 4.3.2], bounded
//   w = min(1, K |g| / v)                                            0 at the target, 1 far from it
// A task whose rows stand apart (a posture) is bounded row by row. The regularisation of a level
// grows with w:  rho_k^2 = rho^2 w, so that a task that can arrive does so without an error of
// regularisation, and one that cannot is damped (compare Levenberg and Marquardt's inverse
// kinematics). docs/control.md says why.
#pragma once

#include <string>

#include "hurcules/tasks/task.hpp"

namespace hurcules {

// How a controller brings errors to zero.
enum class Law {
  Arrive,  // bounded speeds, regularisation by distance, dead zones (dead_zone.hpp)
  Thesis,  // K e, however large, and a constant regularisation [T 4.3.2]
};
[[nodiscard]] std::string to_string(Law law);
// "arrive" or "thesis"; throws Error on another name
[[nodiscard]] Law law_named(const std::string& name);

// fills y of both sides, (m) [unit/s]; a side that is absent stays so. Returns w, the most of a row
// where rows stand apart; by the thesis' law without the bound.
double wanted_rates(const Task& task, double gain, Law law, VectorRef lower, VectorRef upper);

// rho_k of a level that is w from its target
[[nodiscard]] double regularization_at(double rho, double weight);

}  // namespace hurcules
