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

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hurcules/mission/posture_way.hpp"
#include "hurcules/mission/robot_tables.hpp"
#include "hurcules/mission/table.hpp"
#include "hurcules/sim/casualty_watch.hpp"
#include "hurcules/sim/load_watch.hpp"
#include "hurcules/sim/place_watch.hpp"
#include "hurcules/sim/supervisor.hpp"

namespace hurcules {

// What a mission wants to find when it starts.
struct MissionSetup {
  std::string name;
  std::string scene = "";     // file under models/
  std::string keyframe = "";  // where the robot starts; "": where the controller's plan stands
  std::string support = "";   // body that the robot stands on
  double max_seconds =
      std::numeric_limits<double>::infinity();  // [s] it fails when it takes longer
  double min_height = 0.0;  // [m] of the pelvis above the support; below, the robot fell
  double max_tilt = 0.0;    // [rad] of the support against its start; above, the robot fell
  std::vector<ServoGains> servo = {};
  std::string casualty = "";  // prefix of the person's names in the model, "" for nobody to watch
  double stand_off = 0.0;  // [m] of the robot's centre of mass from the person's, before contact,
                           // or from the load
  std::string load = "";   // body of a thing to carry, "" for none
  std::string container = "";    // body of what it is put into, "" for none
  double container_stand = 0.0;  // [m] of the robot's centre of mass from its centre
};

class Mission : public Supervisor {
 public:
  // variation: scale of what differs between seeds (variation.hpp); throws Error as check_table
  Mission(MissionSetup setup, MissionTable table, const WholeBodyController& controller,
          double variation);
  Mission(const Mission&) = delete;
  Mission& operator=(const Mission&) = delete;

  [[nodiscard]] const MissionSetup& setup() const { return setup_; }
  [[nodiscard]] const MissionTable& table() const { return table_; }
  // the phases stand still, the robot holds, until false
  void pause(bool on) { paused_ = on; }
  [[nodiscard]] bool paused() const { return paused_; }
  // it waits for an answer
  [[nodiscard]] bool asks() const { return doing_ == Doing::Asking; }
  void answer(bool yes) { answer_ = yes; }

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
  // mean share of the ways by a rate that the phase has been given, 1 without one
  [[nodiscard]] double given() const;

  std::vector<Figure> figures_;

 private:
  enum class Doing { Leading, Holding, Asking };
  // a condition, and for how long it has been true
  struct Watch {
    Condition condition;
    const double* source = nullptr;
    double since = 0.0;  // [s]
    bool look(double dt);
  };
  struct Way {
    Index row = 0, size = 0;          // of the command
    Vector along;                     // (size) of length 1 for a rate; the whole way, smoothly
    double speed = 0.0;               // [unit] of a rate, 0 for a whole way
    double length = 0.0;              // of a rate
    double given = 0.0;               // of it so far
    Vector by;                        // (size) of a way to what is seen, besides that
    std::vector<const double*> seen;  // what is, null for nothing; empty for another way
    const double* held = nullptr;     // what a rate holds, null for none
    double at = 0.0, span = 0.0;
  };
  struct Row {
    std::vector<Way> ways;
    std::optional<PostureWay> posture;
    Index posture_row = 0, posture_size = 0;
    std::vector<Index> joints;  // of the servo, where no stack rules
    Vector places;              // of these, scratch
    std::string support;        // body that stands, "": the controller's
    std::vector<bool> shut;     // of the brakes that the table names
    std::vector<Watch> done, troubles;
    std::vector<int> late_left;                   // times, of each reaction
    std::vector<std::vector<int>> troubles_left;  // the same
  };
  struct Gauge {  // of a measure
    const double* source = nullptr;
    std::vector<bool> counts;  // a phase
    double seen_least = std::numeric_limits<double>::quiet_NaN(), seen_most = seen_least;
    void look(Measure::Take take, double& value);
  };
  // what it went back, was lowered or aborted for
  struct Why {
    std::size_t phase = 0;  // place + 1, 0: nothing
    std::size_t cause = 0;  // 0 late, else the trouble before it
    bool final = false;     // lowered or aborted
  };
  void compile(const WholeBodyController& controller);
  void find_brakes(const Brakes& brakes);
  static void start_anew(const Phase& phase, Row& row);
  void enter(std::size_t phase, WholeBodyController& controller, double time);
  [[nodiscard]] double progress(double elapsed) const;
  [[nodiscard]] bool over(double time);
  // false: the run is over
  bool react(std::size_t cause, WholeBodyController& controller, double time);
  bool wait(double time, WholeBodyController& controller);
  void tell();
  [[nodiscard]] bool needs_log() const;

  MissionSetup setup_;
  MissionTable table_;
  double variation_;
  const Task* limits_;  // of the first stack, null for none
  Vector initial_qpos_;
  std::vector<Row> rows_;
  std::vector<int> brakes_;  // actuators whose brakes the table names
  std::vector<Gauge> gauges_;
  std::unique_ptr<CasualtyWatch> casualty_;
  std::unique_ptr<LoadWatch> load_;
  std::vector<std::pair<std::string, PlaceWatch>> places_;  // by the prefix of their quantities
  std::vector<Vector> errors_;                              // of these, drawn from the seed
  const mjModel_* model_ = nullptr;
  const mjData_* data_ = nullptr;
  bool attached_ = false, paused_ = false, ended_ = false;
  std::optional<bool> answer_;
  std::size_t phase_ = 0;
  double phase_start_ = 0.0, now_ = 0.0, dt_ = 0.0;  // [s]
  Doing doing_ = Doing::Leading;
  double wait_until_ = 0.0, extra_ = 0.0;  // [s] on top of `within`
  std::size_t cause_ = 0;                  // of what it holds or asks, as in Why
  Why why_;
  double elapsed_ = 0.0, progress_ = 0.0, waiting_ = 0.0;  // columns of the log
  std::vector<std::string> force_names_;                   // of the controller's force tasks
  Vector forces_;                                          // [N] (force tasks) as they read them
  std::string verdict_;
  Vector operated_;
};

}  // namespace hurcules
