// What is seen of a person that the robot lifts: on what the weight rests, where the body's
// centre lies on the arms, what the arms press on each region of the body, and where the robot
// would stand square to it.
//
// Taken from the physics itself; on a robot, load cells of the arms and a camera would tell it. An
// arm that pushes somebody who lies is a contact, judged by its force; one that carries is a
// support, judged by its pressure [test-methods#contact-limits]: at more than kLying of the weight on the
// ground it counts as a contact.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/sim/recorder.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

class CasualtyMonitor {
 public:
  static constexpr double kLying = 0.15;  // share of the weight
  // prefix of all names of the person; throws Error where the model has nobody of this name
  // stand_off [m] >= 0: from the body's centre to the robot's where it stands square to the body,
  // the head to its left
  CasualtyMonitor(const mjModel_* model, const std::string& prefix, double stand_off);
  void add_log_channels(Recorder& log) const;  // "casualty/NAME"
  // ways are counted from where the person lies at the first look after it
  void reset();
  void look(const mjModel_* model, const mjData_* data);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  enum Quantity : Index {
    kOnGround,      // shares of the weight: on the ground,
    kOnLeft,        // on the left arm,
    kOnRight,       // on the right arm,
    kOnBed,         // on the transfer bed,
    kOnRest,        // on any other part of the robot
    kBehindTips,    // [m] the tips are ahead of the body's centre of mass
    kAside,         // [m] the centre is to the left of the middle between the tips
    kHeight,        // [m] the centre is above where it lay
    kMoved,         // [m] and from there along the ground
    kBedAhead,      // [m] it is ahead of the bed's middle, in the frame of the bed
    kBedAside,      // [m] and to the left
    kSag,           // [m] pelvis below (or above) the chest
    kHeading,       // [rad] of the body from pelvis to chest, 0: to the robot's left
    kStandAhead,    // [m] the stand is ahead of the robot's centre of mass
    kStandBearing,  // [rad] and to the left of its way
    kPush,          // [N] of the arms along the ground
    kNeckFlexion,   // [rad] negative: extension
    kNeckBending,   // [rad] to a side
    kNeckTurn,      // [rad]
    kHead,          // [m/s^2] of the head, gravity included
    kContactShare,  // largest force of a contact by the robot, over its region's limit
    kSupport,       // [N] largest force that a region is carried by
    kFaceUp,        // how far the front of the chest looks up: 1 on the back, -1 on the front
    kShift,  // [m] the centre has moved on the arms since they took all of him, level; else 0
    kQuantities
  };
  [[nodiscard]] static const std::vector<std::string>& names();
  void add_up(const mjModel_* model, const mjData_* data);
  void note_shift();

  int root_ = 0, pelvis_ = 0, chest_ = 0, robot_ = 0;  // bodies
  int arms_[2] = {0, 0};                               // bodies, left and right
  int bed_ = -1;                                       // body, -1: the robot has none
  int tips_[2] = {0, 0};                               // sites
  std::vector<bool> is_bed_;                           // (nbody)
  int flexion_ = -1, bending_ = -1, turn_ = -1;        // rows of the neck's sensors, -1: none
  int head_ = -1;                                      // and of the head's
  double stand_off_ = 0.0;                             // [m]
  std::vector<int> region_of_;                         // (nbody), -1: none
  std::vector<std::string> regions_;
  Vector limits_;  // [N] (regions)
  Vector values_;  // (kQuantities)
  Vector forces_;  // [N] (regions) by the robot
  bool looked_ = false, carried_ = false;
  Vector3 origin_ = Vector3::Zero();
  Eigen::Vector2d taken_ = Eigen::Vector2d::Zero();  // [m] behind the tips and aside, when it was
};

}  // namespace hurcules
