// One row of a mission's table, as data: which stack rules, what is led where, when it is over, and
// what happens in trouble. Quantities are columns of the log, by name; those of the mission itself
// begin with "mission/", those of a casualty with "casualty/", and others of the scene become columns
// (scene_quantities.hpp).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

// A quantity on one side of a value, for some time on end.
struct Condition {
  std::string quantity;
  bool above = true;     // the quantity >= value; false: <= value
  double value = 0.0;    // in the unit of the quantity
  double seconds = 0.0;  // [s]
};

enum class ReactionKind {
  Back,   // goes to a phase before this one, or begins this one anew
  Hold,   // stands still for some seconds, then goes on
  Ask,    // stands still until somebody answers: yes goes on, no or silence is the next reaction
  Lower,  // goes to the phase that the table names as the way to safety
  Abort,  // the run is over
};

struct Reaction {
  ReactionKind kind = ReactionKind::Abort;
  std::string phase = "";  // of Back
  double seconds = 0.0;    // [s] of Hold and Ask
  int times = 1;           // in a run; then the next one in the row
};

// What must not be, and what is done about it: the first reaction that is left.
struct Trouble {
  Condition when;
  std::vector<Reaction> reactions;
};

// What the operator's hand does to one channel.
struct Lead {
  std::string channel;
  Vector rate = {};  // [unit of the channel] at which it is led on and on, or
  double way = std::numeric_limits<double>::infinity();  // [unit s] until so much has been given
  Vector by = {};  // [unit s] the way that it is led in the seconds of the phase, smoothly
  // of a channel that sets (Target, ForceReference): what it is set to, in the channel's unit
  Vector value = {};
  // look and move: quantities, one an entry of `by` or `value`, that are added to it as they are when
  // the phase begins; "" adds nothing
  std::vector<std::string> to = {};
  bool follow = false;  // of a value: as they are now
  // a rate that holds a quantity at a value: in full where it is `span` or more below it, none at it,
  // backwards above it
  std::string hold = "";
  double at = 0.0, span = 0.0;  // in the unit of the quantity
  // of a channel of joints: once the quantity is there their brakes bear it, until it has fallen by
  // `span`; then the rate acts in full. Motors that press for long get hot
  bool brake = false;
};

// Angles of coordinates [rad], or places of joints, at a share of a motion, 0 to 1; the others stay as at its beginning.
// "SP" means both "LSP" and "RSP".
struct PostureKey {
  double share = 1.0;
  std::vector<std::pair<std::string, double>> angles;
};

// Where a phase parks the robot: its centre of mass, on the ground, and its heading; counted from a
// body as it is when the phase begins, ahead along its heading (its y axis is its left).
struct Park {
  std::string body = "";           // "": from where the robot stood as the run began
  double ahead = 0.0, left = 0.0;  // [m]
  double heading = 0.0;            // [rad] to the left
  double speed = 0.5;              // [m/s] at most
  double yaw_rate = 0.5;           // [rad/s] at most, turning in place
};

struct Phase {
  std::string name;
  std::string stack;     // of the controller, or "joints": none rules, joints are moved one by one
  double seconds = 0.0;  // [s] that leads by a way and postures take, the least duration
  std::vector<Lead> leads = {};  // channels that are not led hold
  std::string support =
      "";  // body that the robot stands on from here on; "": that of the row before
  std::vector<std::string> brakes = {};  // joints that rest behind their brakes; "SP": both
  std::string posture = "";           // channel of a PostureTask over all coordinates, or of joints
  std::vector<PostureKey> keys = {};  // where that leads to
  std::optional<Park> park = {};      // drives there; not reached: as when it takes too long
  std::vector<Condition> done = {};   // all of them, when all motions have ended
  double within = std::numeric_limits<double>::infinity();  // [s]
  std::vector<Reaction> late = {};                          // when it takes longer
  std::vector<Trouble> troubles = {};
  std::string note = "";  // what it is for, in words: for the printed table and the film
  std::string next = "";  // the phase that it goes on to; "": the one below
  bool last = false;      // the run is over after it: what follows is only reached from elsewhere
};

}  // namespace hurcules
