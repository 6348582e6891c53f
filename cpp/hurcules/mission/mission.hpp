// A mission: a table of phases (phase.hpp) that commands a simulation, and the figures that tell how
// it went.
//
// It is made for a controller, whose stacks, tasks and channels it knows by name. A command moves
// the controller's channels: the mission's own or, in its place, somebody else's; ways count what
// was really commanded. Each phase begins with the references where they are: its stack takes over
// the present velocity, its targets hold, and its ways start from there.
//
// Each tick, after the figures: what is in trouble reacts (the first reaction that is left), what is
// late reacts, what is done goes on. While it holds or asks the phase's clock stands.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hurcules/mission/gauges.hpp"
#include "hurcules/mission/mission_setup.hpp"
#include "hurcules/mission/phase_row.hpp"
#include "hurcules/mission/robot_tables.hpp"
#include "hurcules/mission/scene_monitors.hpp"
#include "hurcules/mission/scene_quantities.hpp"
#include "hurcules/mission/table.hpp"
#include "hurcules/sim/supervisor.hpp"
#include "hurcules/sim/support_part.hpp"

namespace hurcules {

class Mission : public Supervisor {
 public:
  // variation: scale of what differs between seeds (variation.hpp); throws Error as check_table, and
  // for a setup that is out of range or names a support that the robot has not; its first run throws
  // for supports that do not lie on the ground (support_check.hpp)
  Mission(MissionSetup setup, MissionTable table, const WholeBodyController& controller,
          double variation);
  Mission(const Mission&) = delete;
  Mission& operator=(const Mission&) = delete;

  [[nodiscard]] const MissionSetup& setup() const { return setup_; }
  [[nodiscard]] const MissionTable& table() const { return table_; }
  void attach(const Plant& plant, Recorder& log) override;
  Vector start(const Plant& plant, Robot& robot, std::uint64_t seed) override;
  void reset(WholeBodyController& controller, const Robot& world) override;
  const Vector& command(double dt) override;
  void brake(Brakes& brakes) final;
  void note_commanded(const WholeBodyController& controller, const TickReport& report) final;
  void note_measured(const TickReport& report) final;
  bool advance(WholeBodyController& controller, double time) override;
  void go(std::size_t phase, WholeBodyController& controller, double time) override {
    enter(phase, controller, time);
  }
  void pause() override;
  void resume(WholeBodyController& controller, double time) override;
  [[nodiscard]] bool paused() const override { return paused_; }
  [[nodiscard]] std::optional<Cause> reacted() const override { return reacted_; }
  [[nodiscard]] std::string text(const Cause& cause) const override;
  [[nodiscard]] bool unborne() const override { return unborne_; }
  [[nodiscard]] std::string waits_for() const override;
  [[nodiscard]] std::optional<double> asks_until() const override;
  [[nodiscard]] std::string question() const override;
  void answer(bool yes) override { answer_ = yes; }
  [[nodiscard]] std::vector<std::string> phase_names() const override;
  [[nodiscard]] std::size_t phase() const override { return phase_; }
  [[nodiscard]] const std::vector<Figure>& figures() const override { return figures_; }
  [[nodiscard]] std::string_view verdict() const override { return verdict_; }
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] std::unique_ptr<Supervisor> clone(WholeBodyController& controller) const override;

 protected:
  // what a mission of its own adds: at the start, at each phase, after each half of a tick
  virtual void begin(WholeBodyController& /*controller*/, const Robot& /*world*/) {}
  virtual void entered(double /*time*/) {}
  virtual void commanded(const WholeBodyController& /*controller*/, const TickReport& /*report*/) {}
  virtual void measured(const TickReport& /*report*/) {}
  virtual void save_memory(StateWriter& /*writer*/) const {}
  virtual void restore_memory(StateReader& /*reader*/) {}
  [[nodiscard]] double variation() const { return variation_; }
  std::vector<Figure> figures_;

 private:
  enum class Doing { Leading, Holding, Asking };
  // what it went back, was lowered or aborted for
  struct Why {
    std::size_t phase = 0;  // place + 1, 0: nothing
    std::size_t cause = 0;  // 0 late, else the trouble before it
    std::size_t unmet = 0;  // of one that is late: place + 1 of the condition that was not true
    double value = 0.0;     // what its quantity was
    bool final = false;     // lowered or aborted
  };
  [[nodiscard]] Why why(std::size_t cause, bool final = false) const;  // of the present phase
  void find_brakes(const Brakes& brakes);
  void look_at_support();
  void enter(std::size_t phase, WholeBodyController& controller, double time);
  [[nodiscard]] bool over(double time);
  // to a trouble, by its number, or to being late; false: the run is over
  bool react(std::optional<std::size_t> trouble, WholeBodyController& controller, double time);
  bool wait(double time, WholeBodyController& controller);
  [[nodiscard]] bool rules(const WholeBodyController& controller) const;
  void tell();
  // phase and condition that it is in trouble with, in words
  [[nodiscard]] std::string words(const Why& why) const;
  [[nodiscard]] std::string unmet_words(const Why& why) const;  // what had not come true
  [[nodiscard]] bool needs_log() const;

  MissionSetup setup_;
  MissionTable table_;
  double variation_;
  const JointLimits* limits_;  // of the first stack, null for none
  Vector initial_qpos_;
  int root_body_;
  std::vector<PhaseRow> rows_;
  std::vector<int> brakes_;  // actuators whose brakes the table names
  Gauges gauges_;
  SceneMonitors scene_;
  SceneQuantities quantities_;
  const Plant* plant_ = nullptr;
  std::map<std::string, SupportPart> parts_;  // of the bodies that rows stand on
  bool supports_checked_ = false, paused_ = false, ended_ = false;
  bool moved_ = false;  // by somebody else's command while it was paused
  std::optional<bool> answer_;
  std::size_t phase_ = 0;
  double phase_start_ = 0.0, now_ = 0.0, dt_ = 0.0;  // [s]
  Doing doing_ = Doing::Leading;
  double wait_until_ = 0.0, extra_ = 0.0;  // [s] on top of `within`
  std::size_t cause_ = 0;                  // of what it holds or asks, as in Why
  Why why_;
  double elapsed_ = 0.0, progress_ = 0.0, waiting_ = 0.0;  // columns of the log
  double unborne_for_ = 0.0;  // [s] for so long has the support borne nothing; stays once told
  bool unborne_ = false;      // in this tick it is to be told
  std::vector<std::string> force_names_;  // of the controller's force tasks
  Vector forces_;                         // [N] (force tasks) as they read them
  std::string verdict_;
  std::optional<Cause> reacted_;  // in the last advance
  Vector idle_;                   // (k) the command that leaves all as it is
  Vector operated_;
};

}  // namespace hurcules
