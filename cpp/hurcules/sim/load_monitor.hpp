// What is seen of a thing that two hands carry: on what its weight rests, how hard each hand holds
// it, whether it slips, how fast it sinks, and where it lies in its container.
//
// Taken from the physics itself, but for how hard the hands hold it: that is what the springs of the
// fingers' pads are pressed by. On a robot, load cells of the wrists would tell most of the rest.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/sim/recorder.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

class LoadMonitor {
 public:
  // bodies: of the thing, with sites BODY_left and BODY_right where the hands hold it; of the
  // container, "" for none. Throws Error for names that the model has not.
  LoadMonitor(const mjModel_* model, const std::string& body, const std::string& container);
  void add_log_channels(Recorder& log, const std::string& prefix) const;  // "PREFIX/NAME"
  // looks; heights and ways are counted from the next look on
  void reset(const mjModel_* model, const mjData_* data);
  void look(const mjModel_* model, const mjData_* data);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  enum Quantity : Index {
    kOnGround,     // shares of the weight: on the ground,
    kOnLeft,       // on the left hand,
    kOnRight,      // on the right hand,
    kOnRest,       // on any other part of the robot,
    kInContainer,  // on the container
    kLeft,     // [N] the fingers of the left hand press, sum, as the springs of their pads tell,
    kRight,    // [N] and those of the right one
    kKnock,    // [N] other parts of the robot press on it, or the robot on the container
    kHeight,   // [m] the centre is above where it stood
    kMoved,    // [m] and from there along the ground
    kTilt,     // [rad] of its z axis
    kSinking,  // [m/s] downwards
    kOff,      // [m] the places to grasp from the hands, the larger
    kAhead,    // [m] its centre from the container's, in the container's frame: ahead,
    kAside,    // [m] to the left,
    kUp,       // [m] and up
    kQuantities
  };
  [[nodiscard]] static const std::vector<std::string>& names();
  void add_up(const mjModel_* model, const mjData_* data);

  int body_ = 0, container_ = -1, robot_ = 0;  // bodies; -1: none
  int tips_[2] = {0, 0}, places_[2] = {0, 0};  // sites, left and right
  struct Pad {
    int address = 0;         // of its joint in qpos
    double stiffness = 0.0;  // [N/m]
  };
  std::vector<Pad> pads_[2];  // of the fingers, left and right
  std::vector<int> hand_;     // (nbody) 0 left, 1 right, -1 no hand
  Vector values_;             // (kQuantities)
  bool looked_ = false;
  Vector3 origin_ = Vector3::Zero();
};

}  // namespace hurcules
