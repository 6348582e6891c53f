// The quadruped with round feet and an arm, above a floor.
#pragma once

#include "hurcules/robot/robot.hpp"

namespace hurcules_test {

inline hurcules::ModelPtr quadruped() {
  return hurcules::load_model(HURCULES_MODELS "/examples/quadruped.xml");
}

}  // namespace hurcules_test
