// A phase as it runs: a row of the table with places in place of names, how far its ways have come,
// for how long its conditions have been true, and which reactions are left.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hurcules/mission/park_way.hpp"
#include "hurcules/mission/posture_way.hpp"
#include "hurcules/mission/scene_quantities.hpp"
#include "hurcules/mission/table.hpp"
#include "hurcules/sim/brakes.hpp"

namespace hurcules {

class PhaseRow {
 public:
  // Keeps the phase, which check_table has passed. support: body that the robot stands on in it.
  PhaseRow(const Phase& phase, std::string support, const WholeBodyController& controller);
  // throws Error with the columns that exist
  void find_quantities(SceneQuantities& scene);
  // its brakes, of whose actuators it tells: shut in it all along or at times; throws Error with the
  // joints that have one
  std::vector<int> find_brakes(const Brakes& brakes);
  // what it parks by; throws Error with the bodies that exist
  void find_places(const Plant& plant, int robot);
  // whether what its leads hold is where their brakes bear it
  void look_at_brakes(double dt);
  // what the phase before held alike goes on being borne
  void go_on_bearing(const PhaseRow& before);
  // this brake, in this tick; `still`: the mission leads nothing, and what is held is borne, whatever
  // is read of it, unless an operator moves it
  [[nodiscard]] bool shuts(int actuator, bool still) const;
  [[nodiscard]] const std::string& support() const { return support_; }
  [[nodiscard]] bool needs_log() const;

  // a run begins: all reactions are left
  void reset();
  // The phase begins where the references are. A way to what is seen that is longer than the scale
  // of its channel gives in the seconds of the phase takes the time that it needs.
  void enter(const WholeBodyController& controller);
  // once a tick, after the physics; `rules`: it is the present phase
  void look(bool rules) {
    if (park_) park_->look(rules);
  }
  // what it commands over the dt [s] after a time [s] since its beginning; writes its own rows of
  // the command (k)
  void command(double time, double dt, Vector& out);
  // what was really commanded, beside what the row said
  void note(const WholeBodyController& controller, const Vector& own);
  // mean share of the ways by a rate that has been given, 1 without one
  [[nodiscard]] double given() const;
  // what it sets counts from the next tick on: until then errors are those of what was set before
  [[nodiscard]] double progress(double elapsed) const;
  // it cannot end as it should: it did not park
  [[nodiscard]] bool failed() const { return blind() || (park_ && park_->failed()); }
  // a quantity of a way that was no number when the phase began, null for none
  [[nodiscard]] const std::string* blind() const;
  // [s] that it takes longer than its table says, by a way to what is seen
  [[nodiscard]] double longer() const { return seconds_ - phase_->seconds; }
  // one more tick of dt [s]: all its conditions are true; the first of its troubles that there is
  [[nodiscard]] bool done(double dt);
  [[nodiscard]] std::optional<std::size_t> trouble(double dt);
  // the first of its conditions that is not true, by its number
  [[nodiscard]] std::optional<std::size_t> unmet() const;
  // what the quantity of a condition is
  [[nodiscard]] double value_of(std::size_t condition) const { return *done_[condition].source; }
  // what is done about a trouble, by its number, or about being late
  [[nodiscard]] const std::vector<Reaction>& reactions(std::optional<std::size_t> trouble) const;
  // the number of the first of these that is left, which is then one less
  std::optional<std::size_t> react(std::optional<std::size_t> trouble);
  // asked for it, somebody says yes: the trouble is none until it has been away once
  void excuse(std::size_t trouble);
  // no, or nothing: it is not asked again
  void refuse(std::optional<std::size_t> trouble);

  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  // a condition, and for how long it has been true
  struct TimedCondition {
    Condition condition;
    const double* source = nullptr;
    double since = 0.0;  // [s], below 0: excused
    bool look(double dt);
    [[nodiscard]] bool now() const;
  };
  struct Way {
    Index row = 0, size = 0;           // of the command
    Vector along;                      // (size) of length 1 for a rate; the whole way, smoothly
    double speed = 0.0;                // [unit] of a rate, 0 for a whole way
    double length = 0.0;               // of a rate
    double given = 0.0;                // of it so far
    Vector by;                         // (size) of a way to what is seen, besides that; or a value
    bool set = false, follow = false;  // `along` is what the channel is set to
    std::vector<const double*> seen;   // what is, null for nothing; empty for another way
    const double* held = nullptr;      // what a rate holds, null for none
    double at = 0.0, span = 0.0;
    std::vector<std::string> braked;  // joints whose brakes bear what is held
    std::vector<int> brakes;          // their actuators
    bool borne = false;               // by these, as of the last tick
    double fallen = 0.0;              // [s] for so long has it been `span` below
    bool operated = false;            // somebody else moved it in the last tick
  };
  // at what it goes to; what is no number is passed over. Returns its place in `to`, -1 for none
  static Index look(Way& way);
  [[nodiscard]] static Way way_of(const Lead& lead, const WholeBodyController& controller,
                                  const std::string& where);
  void forget();  // for how long conditions have been true, and how far ways have come

  const Phase* phase_;
  std::string support_;
  std::vector<Way> ways_;
  Index blind_way_ = -1, blind_entry_ = -1;
  double seconds_ = 0.0;  // of the phase, more where a way to what is seen takes longer
  std::optional<PostureWay> posture_;
  std::optional<ParkWay> park_;
  Index posture_row_ = 0, posture_size_ = 0;
  std::vector<Index> joints_;  // of the servo, where no stack rules
  Vector places_;              // of these, scratch
  std::vector<int> brakes_;
  std::vector<TimedCondition> done_, troubles_;
  std::vector<std::vector<int>> left_;  // times, of each reaction: late, then each trouble's
};

}  // namespace hurcules
