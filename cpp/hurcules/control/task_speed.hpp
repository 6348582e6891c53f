// What the tasks of a level ask for, none faster than its max_speed, none braking harder than its
// max_acceleration.
//
//   g = side - e where that side pushes, 0 inside the interval       (m), unit
//   f = K |g| / max_speed of a task, K its own or the controller's, but 1 / dt at most: an error that
//       is corrected by more than itself in a period grows
//   w = min(1, the largest f of the level's tasks)                  0 at the target, 1 far from it
//   F = the largest f, or K |g| / v_b:  v_b^2 = 2 a |g| - (a / K)^2 beyond |g| = a / K^2, from where
//       K g brakes within a = 0.9 max_acceleration
//   y = ds_des/dt + K g / max(1, F)                                  [T 4.3.2], bounded
// One F for a level: y is the gradient of its squared error, only slower, so that a level that
// cannot arrive ends where that is least. The rows of a task that stand apart (a posture) have an f
// each. The regularisation of a level grows with w:  rho_k^2 = rho^2 w, so that a task that can
// arrive does so without an error of regularisation, and one that cannot is damped (compare
// Levenberg and Marquardt's inverse kinematics). docs/control.md says why.
#pragma once

#include <string>

#include "hurcules/solver/hierarchy.hpp"
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

// f of a task, the largest of its rows where they stand apart; gain [1/s] of the controller, dt [s]
[[nodiscard]] double haste(const Task& task, double gain, double dt);

// K |g| / v_b of a task, likewise; 0 where it brakes within max_acceleration by itself
[[nodiscard]] double braking(const Task& task, double gain, double dt);

// fills y of both sides, (m) [unit/s]; a side that is absent stays so. `most` is F, or anything up
// to 1 for no bound; rows that stand apart have their own.
void wanted_rates(const Task& task, double gain, double dt, double most, VectorRef lower,
                  VectorRef upper);

// the row of a level as its weight in the task wants it
void weigh_row(const Task& task, Index row, Level& level, Index level_row);
void weigh_sides(double weight, double& lower, double& upper);  // the same of its sides alone

// rho_k of a level that is w from its target
[[nodiscard]] double regularization_at(double rho, double weight);

}  // namespace hurcules
