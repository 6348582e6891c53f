// How much further coordinates give way to an effort where joints beside them are free: what a
// controller that reckons with the coordinates' inertia alone finds its gains multiplied by.
#pragma once

#include <memory>
#include <vector>

#include "hurcules/robot/robot.hpp"

struct mjData_;

namespace hurcules {

class LooseJoints {
 public:
  // dofs: of hinges and slides that no coordinate of the robot moves
  LooseJoints(const Robot& robot, std::vector<int> dofs);

  // The largest eigenvalue of S^-1 M at the robot's configuration, its root held: M the inertia of the
  // coordinates, the other joints locked, and S that with the other joints free (its Schur
  // complement). 1 without any, infinite where they have no inertia.
  [[nodiscard]] double gain(const Robot& robot);

 private:
  std::vector<int> dofs_;
  std::unique_ptr<mjData_, void (*)(mjData_*)> data_;
  Matrix motion_;  // (nv, coordinates and dofs) of the model's joints by them
};

}  // namespace hurcules
