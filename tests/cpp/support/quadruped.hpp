// The quadruped with round feet and an arm, above a floor.
#pragma once

#include "hurcules/robot/robot.hpp"
#include "support/models.hpp"

namespace hurcules_test {

inline hurcules::ModelPtr quadruped() {
  return hurcules::load_model(models("/examples/quadruped.xml"));
}

}  // namespace hurcules_test
