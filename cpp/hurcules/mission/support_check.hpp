// Whether the bodies that a table says the robot stands on can bear it where their phases begin, as
// far as that can be told before a run.
//
// The posture is followed through the table: where the run starts, then what postures lead to; driving
// changes none. A lead of a task, and whatever force and hands leave open, makes all coordinates
// unknown until a posture names them: of bodies that these move against the support nothing is said.
#pragma once

#include "hurcules/mission/table.hpp"
#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/plant.hpp"

namespace hurcules {

// The robot as a run starts: `world` stands there, as the contacts of the plant tell, too: on a slope
// up is their normal, and what bears by them fits. first: the support of the mission, "" for that of
// the controller, which is not looked at.
// Throws Error that names the row, the body, how far it is off the ground, and what lies there. A robot
// whose root is fixed, or a coordinate, stands on nothing, one with closed loops is not followed:
// nothing is told.
struct StandingStart {
  const Robot& world;
  const Plant& plant;
  std::string first;
};
void check_supports(const MissionTable& table, const WholeBodyController& controller,
                    const StandingStart& start);

}  // namespace hurcules
