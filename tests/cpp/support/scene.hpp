// The scene of the stretch, compiled once for a test program.
#pragma once

#include <string>

#include "hurcules/robot/robot.hpp"
#include "support/models.hpp"

namespace hurcules_test {

inline const hurcules::ModelPtr& stretch_scene() {
  static const hurcules::ModelPtr model = hurcules::load_model(models("/scenes/stretch.xml"));
  return model;
}

}  // namespace hurcules_test
