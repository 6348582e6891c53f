// Where a thing is, as a camera of the robot tells it: a body of the scene, seen from the robot,
// with the error of an estimate, and where the robot would stand square to it.
//
// The robot's frame: origin below the knee axis, x ahead, y to its left, z up. The error is that of
// a calibration: drawn once a run, it grows with the distance from the head, along the line of sight
// as that of a stereo pair does, and shrinks as the robot comes near. Whether the thing is in the
// picture is not asked.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/sim/recorder.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

// standard deviations at a distance of kAt: stereo of 0.12 m base, half a pixel of 1280 over
// 60 degrees
struct CameraError {
  static constexpr double kAt = 1.5;                   // [m]
  static constexpr double kAlong = 8e-3;               // [m] by the distance squared
  static constexpr double kAcross = 3e-3, kUp = 3e-3;  // [m] by the distance
  static constexpr double kTurn = 0.02;                // [rad] by the distance
};

class PlaceMonitor {
 public:
  // body: of the thing; where it has sites BODY_left and BODY_right, these are places to grasp.
  // stand_off [m] >= 0: from its centre to the robot's centre of mass (about which it turns) where it
  // stands square to it, the thing's x axis ahead. Throws Error where the model has no such body, or is not of Hurcules.
  PlaceMonitor(const mjModel_* model, const std::string& body, double stand_off);
  void add_log_channels(Recorder& log, const std::string& prefix) const;  // "PREFIX/NAME"
  // the errors of this run over their standard deviations: along, across, up, turn
  void set_error(const Vector& error) { error_ = error; }
  void look(const mjModel_* model, const mjData_* data);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  enum Quantity : Index {
    kAhead,            // [m] of the knee axis,
    kAside,            // [m] to the left of the robot's middle,
    kHeading,          // [rad] turned to the left against the robot
    kStandAhead,       // [m] the stand is ahead of the robot
    kStandBearing,     // [rad] and to the left of its way
    kHandsAhead,       // [m] ahead of the middle between the hands,
    kHandsAside,       // [m] and to the left of it
    kPlaces,           // what follows wants places to grasp
    kLeftX = kPlaces,  // [m] from the left hand to its place: ahead,
    kLeftY,            // [m] to the left,
    kLeftZ,            // [m] and up
    kRightX,
    kRightY,
    kRightZ,
    kQuantities
  };
  [[nodiscard]] static const std::vector<std::string>& names();

  int body_ = 0, robot_ = 0;  // bodies
  int eyes_ = 0;              // site
  int tips_[2] = {0, 0};      // sites of the hands, left and right
  int places_[2] = {-1, -1};  // sites of the thing, the same; -1: it has none
  double stand_off_;          // [m]
  Vector error_ = Vector::Zero(4);
  Vector values_;  // (kPlaces) or (kQuantities)
};

}  // namespace hurcules
