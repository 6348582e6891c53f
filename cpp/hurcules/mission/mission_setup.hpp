// What a mission wants to find when it starts.
#pragma once

#include <limits>
#include <string>

namespace hurcules {

struct MissionSetup {
  std::string name;
  std::string scene = "";     // file under models/
  std::string keyframe = "";  // where the robot starts; "": where the controller's plan stands
  std::string support = "";   // body that the robot stands on
  double max_seconds =
      std::numeric_limits<double>::infinity();  // [s] it fails when it takes longer
  std::string fall_frame = "";  // whose height above the support is watched; "": none is
  double min_height = 0.0;      // [m] of that; below, the robot fell
  double max_tilt = 0.0;        // [rad] of the support against its start; above, the robot fell
  std::string casualty = "";    // prefix of the person's names in the model, "" for nobody to watch
  double stand_off = 0.0;  // [m] of the robot's centre of mass from the person's, before contact,
                           // or from the load
  std::string load = "";   // body of a thing to carry, "" for none
  std::string container = "";    // body of what it is put into, "" for none
  double container_stand = 0.0;  // [m] of the robot's centre of mass from its centre
};

}  // namespace hurcules
