// Tells from force readings, one a tick, whether there is contact, too much of it, or no sensor.
//
//   Free -> Contact       at |f| >= f_min                                    [T 5.7.64]
//   Contact -> Free       after |f| < f_min / 2 for release_time, or < |f_d| / 2 where a force f_d
//                         below f_min is wanted
//   any -> Stopped        at |f| > f_max, until reset; readings go on        [T 5.7.64]
//   any -> SensorLost     no finite reading for patience, or where it presses a reading that keeps
//                         its bits while the frame moves by frozen_move; until reset
// A sensor that reads a constant 0 in the air cannot be told from no contact. One with coarse steps
// may well keep its bits: where, after 20 changes, readings are multiples of the smallest of
// them, and that is no small part of f_min, kept bits say nothing.
#pragma once

#include <string>

#include "hurcules/base/state.hpp"

namespace hurcules {

enum class ContactState { Free, Contact, Stopped, SensorLost };
[[nodiscard]] std::string to_string(ContactState state);

struct ContactOptions {
  double f_min = 2.5;          // [N] > 0 [T §5.7.2]
  double f_max = 150.0;        // [N] > f_min; no value in the thesis
  double release_time = 0.05;  // [s]
  double patience = 0.01;      // [s] the last reading stands for those that are missing
  double frozen_move = 5e-4;   // [m] along the axis; 0: not looked for
  double dt = 1e-3;            // [s]
};

class ContactMonitor {
 public:
  // throws Error, naming the task
  ContactMonitor(const ContactOptions& options, const std::string& task);
  // a reading [N], any number, with the frame at this place along the axis [m]
  ContactState look(double reading, double position);
  // the force that is wanted [N], of any sign
  void expect(double force_des);
  [[nodiscard]] ContactState state() const { return state_; }
  [[nodiscard]] double force() const { return force_; }      // [N] the last one that was read
  [[nodiscard]] double release() const { return release_; }  // [N] where a contact ends
  // out of Stopped and SensorLost
  void reset();
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  ContactOptions options_;
  ContactState state_ = ContactState::Free;
  double force_ = 0.0;
  double quiet_ = 0.0, missing_ = 0.0;  // [s] for how long
  double changed_at_ = 0.0;             // [m] where the reading changed last
  double release_ = 0.0;                // [N]
  double step_ = 0.0;                   // [N] smallest change so far, 0 before one
  double changes_ = 0.0;                // of the reading so far
  bool coarse_ = false;
  void learn_step(double reading);
};

}  // namespace hurcules
