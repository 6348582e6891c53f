// The way to a pose on the ground that a phase parks at (control/parking.hpp): where it counts from is
// looked at when the phase begins. The robot is where its centre of mass is, about which it turns.
#pragma once

#include <optional>
#include <string>

#include "hurcules/control/parking.hpp"
#include "hurcules/control/whole_body_controller.hpp"
#include "hurcules/mission/phase.hpp"
#include "hurcules/sim/plant.hpp"

namespace hurcules {

class ParkWay {
 public:
  // row: of the command, where the channel of the tracks begins
  ParkWay(const Park& park, Index row, double dt);
  // throws Error where the model has no such body; `where` for the text
  void attach(const Plant& plant, int robot, const std::string& where);
  // a run begins
  void reset();
  // the phase begins: it aims as soon as it has looked
  void enter();
  // once a tick, after the physics; `rules`: its phase is the present one
  void look(bool rules);
  // writes its two entries of the command (k)
  void command(Vector& out);
  // what came of it: both drives stand behind their brakes
  void note(bool braked) { stopped_ = braked; }
  [[nodiscard]] bool done() const { return parking_.phase() == ParkingPhase::Done; }
  [[nodiscard]] bool failed() const { return parking_.phase() == ParkingPhase::Failed; }
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  Park park_;
  Index row_;
  Parking parking_;
  const Plant* plant_ = nullptr;
  int robot_ = 0, body_ = -1;  // of the model; -1: the place at the start
  PlanarPose start_, here_;    // of the robot as the run began, and now
  bool started_ = false, aimed_ = false, stopped_ = false;
};

}  // namespace hurcules
