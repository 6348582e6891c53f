// Where the bodies around a robot are, and how they move: told to the distance tasks that keep clear
// of them.
#pragma once

#include <vector>

#include "hurcules/control/tasks.hpp"
#include "hurcules/control/whole_body_controller.hpp"
#include "hurcules/sim/plant.hpp"

namespace hurcules {

class ObstacleSight {
 public:
  // all bodies that may move, of all distance tasks of a controller
  ObstacleSight(const WholeBodyController& controller, const Robot& world);

  // world: the robot as it is, qvel (nv) then; dt [s] since it was told last. A mocap body has no
  // velocity of its own: it is taken from where it was.
  void tell(const Robot& world, const Plant& plant, const Vector& qvel, double dt) const;

 private:
  struct Obstacle {
    DistanceTask* task = nullptr;
    int body = 0;
    int mocap = -1;  // the mocap body that it is or hangs on
  };
  std::vector<Obstacle> obstacles_;
};

}  // namespace hurcules
