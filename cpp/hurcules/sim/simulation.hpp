// The closed loop: plant and controller, with sensors, monitors, battery and recorder. For any
// robot; a mission may command it from above, but none is needed.
//
//   sense -> controller (kinematics, hierarchy, solve, servo) -> plant -> record
//
// The controller is told what the sensors say (sensors.hpp), which is the truth unless a model or a
// fault is given. Where the encoders cannot be believed the robot is held: its reference stops, its
// brakes close. Same start, seed and commands: same bits. A run that leaves the numbers' range, or
// falls, or is held, ends with a reason; it never throws.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hurcules/sim/battery.hpp"
#include "hurcules/sim/fall_monitor.hpp"
#include "hurcules/sim/limit_monitor.hpp"
#include "hurcules/sim/measured_tasks.hpp"
#include "hurcules/sim/obstacle_sight.hpp"
#include "hurcules/sim/plant.hpp"
#include "hurcules/sim/power_meter.hpp"
#include "hurcules/sim/run_record.hpp"
#include "hurcules/sim/sensors.hpp"
#include "hurcules/sim/supervisor.hpp"

namespace hurcules {

// A run ends where this frame is too low above the controller's support, or the support tilts. The
// support of a robot that floats is its root: there the height is that above z = 0 of the world.
struct FallOptions {
  std::string frame = "";                                        // "": no height is watched
  double min_height = -std::numeric_limits<double>::infinity();  // [m] of the frame
  double max_tilt =
      std::numeric_limits<double>::infinity();  // [rad] of the support against its start
};

struct SimulationOptions {
  std::uint64_t seed = 0;
  bool record = true;  // keep the time series
  // false: the robot is where its references are, at once and whatever it touches; nothing else
  // moves, no force acts, no monitor looks. For learning at a fraction of the time.
  bool physics = true;
  // a command is added to what the supervisor commands, in place of taking its place
  bool adds_command = false;
  // sprung hinges without a motor start where they bear what hangs on them; the plan is the same
  bool loaded_springs = false;
  Clock clock = nullptr;  // [s] for timings; null: none are taken
  double max_seconds = std::numeric_limits<double>::infinity();
  FallOptions fall = {};
  PowerOptions power = {};      // what the robot takes
  BatteryOptions battery = {};  // from where
  SensorOptions sensors = {};   // ideal without models
  MonitorOptions monitors = {};
};

// Why a run is over.
enum class Ending { Running, Completed, Missed, TimeUp, Fell, Diverged, SolverFailed, Held };

class Simulation {
 public:
  // Starts where the controller's plan stands, targets that somebody has set stay, or where and as
  // the supervisor says. `data` is somebody else's, who keeps it alive, or null for data of its own.
  // Throws Error for a controller of another model, or one whose period is no whole number of physics
  // steps.
  Simulation(ModelPtr model, std::shared_ptr<WholeBodyController> controller,
             SimulationOptions options = {}, std::unique_ptr<Supervisor> supervisor = nullptr,
             mjData_* data = nullptr);
  // The same loop in the same state, with data, controller and supervisor of its own; `model` may
  // differ in its numbers, null: this one's. The controller goes on reckoning with the model that
  // it has, so that it does not know what differs. It records nothing, and without physics and mission
  // its mjData has the positions of its joints, not what MuJoCo makes of them: nobody looks there.
  [[nodiscard]] std::unique_ptr<Simulation> clone(ModelPtr model = nullptr) const;
  virtual ~Simulation() = default;

  // up to n ticks of the controller; fewer when the run ends. command (k) in SI, held to its scale;
  // null: the supervisor's own operator, and without one all targets hold; begins: a `Delta` of the
  // command counts, once
  int step(int n = 1, const Vector* command = nullptr, bool begins = true);
  // back to the start; `start` (nq): where that is this time, whatever a supervisor would draw
  void reset(std::uint64_t seed, const Vector* start = nullptr);
  // The brake of a joint, open after reset. A joint rests behind its shut brake: the plan does not
  // know, so that its coordinate is to be held too. An empty battery closes all.
  void set_brake(const std::string& joint, bool closed);

  // begins this phase of the supervisor's now, out of its order. Throws Error without a supervisor,
  // and for a phase that it has not.
  void go(std::size_t phase);
  // To take over by hand: the supervisor's phase, its clock and its time-out stand still, and nobody
  // looks for its troubles; the robot holds, or does what `step` is given. `resume`: it goes on where
  // it was, or, where a command moved something meanwhile, begins its phase anew from where the robot
  // is. `max_seconds` and falls count all the time. Throws Error without a supervisor.
  void pause();
  void resume();
  [[nodiscard]] bool paused() const { return supervisor_ && supervisor_->paused(); }
  // what the supervisor asks (a mission's reaction `ask`), "" for nothing
  [[nodiscard]] std::string question() const;
  // yes: the phase goes on; no: the next reaction. Throws Error where nothing is asked.
  void answer(bool yes);
  // the operator's link is alive: `link_age` counts from now on
  void heartbeat() { heard_ = time(); }
  // [s] since the last heartbeat of this run, 0 before the first: who has no link cannot lose it
  [[nodiscard]] double link_age() const;

  [[nodiscard]] double dt() const { return controller_->dt(); }         // [s]
  [[nodiscard]] double time() const { return record_.telemetry.time; }  // [s] since reset
  [[nodiscard]] Ending ending() const { return ending_; }
  [[nodiscard]] bool finished() const { return ending_ != Ending::Running; }
  [[nodiscard]] bool success() const { return ending_ == Ending::Completed; }
  [[nodiscard]] bool physics() const { return options_.physics; }
  [[nodiscard]] bool records() const { return options_.record; }  // its log
  [[nodiscard]] std::string reason() const;                       // "" while running
  // its sensors cannot be believed: it stands behind its brakes until the run ends
  [[nodiscard]] bool held() const { return finding_.trouble != SensorMonitor::Trouble::None; }
  [[nodiscard]] Vector operator_command();  // of the next tick, (k)

  // All that decides how the run goes on; any simulation of this model and controller can restore it.
  // Its length is always the same, and no number in it is NaN.
  [[nodiscard]] std::vector<double> state() const;
  void restore(const std::vector<double>& values);

  [[nodiscard]] const std::vector<std::string>& levels() const { return record_.names().levels; }
  [[nodiscard]] const Telemetry& telemetry() const;
  [[nodiscard]] const Recorder& log() const;
  [[nodiscard]] const Recorder& timings() const { return record_.timings; }  // [s] a stage and tick
  // what a policy sees now: its channels and snapshot()
  // (measured: the errors of the tasks too)
  [[nodiscard]] const Recorder& observation(bool measured = true) const;
  [[nodiscard]] const LimitMonitor& limits() const { return limit_monitor_; }
  [[nodiscard]] const EventList& events() const { return record_.events; }
  [[nodiscard]] std::string text(const Event& event) const {
    if (event.kind != EventKind::Reacted) return record_.text(event, monitors_);
    return supervisor_->text({static_cast<std::size_t>(event.what),
                              static_cast<std::size_t>(event.side),
                              static_cast<std::size_t>(event.answer)});
  }
  [[nodiscard]] Plant& plant() { return plant_; }
  [[nodiscard]] const Plant& plant() const { return plant_; }
  // the same for a copy of it, another one for another model, controller or mission
  [[nodiscard]] double identity() const { return identity_; }
  [[nodiscard]] const Robot& world() const { return world_; }  // the robot as it is
  // a task of the controller, by its number, measured at the robot as it is
  [[nodiscard]] const Task& measured_task(std::size_t number) const {
    return measured_.at(number, world_);
  }
  [[nodiscard]] const Battery& battery() const { return battery_; }
  [[nodiscard]] WholeBodyController& controller() { return *controller_; }
  [[nodiscard]] const WholeBodyController& controller() const { return *controller_; }
  [[nodiscard]] const Supervisor* supervisor() const { return supervisor_.get(); }
  [[nodiscard]] const Sensors& sensors() const { return sensors_; }
  [[nodiscard]] const Monitors& monitors() const { return monitors_; }
  // the supervisor's, then the worst that the monitors saw
  [[nodiscard]] std::vector<Figure> figures() const;

 private:
  void tick(const Vector* command, bool first);
  void think(const RobotState& state, const Vector* command, bool first, StageTimer& timer);
  void sense();
  void check_sensors();
  void actuate(const RobotState& state);
  void advance_plant();
  void advance_plan();
  void record();
  [[nodiscard]] double height() const;
  void judge();
  void stand_on_new_support();

  void begin(std::uint64_t seed, const Vector* start, bool keep_targets);
  void place(std::uint64_t seed, const Vector* start, bool keep_targets);
  void measure_state();  // how long a snapshot is, and what it is of
  void write(std::vector<double>& values) const;
  void read(const std::vector<double>& values);
  [[nodiscard]] RobotState sensed();
  [[nodiscard]] const Robot& seen() const { return seen_ ? *seen_ : world_; }
  void measure_world() const;
  void note_base() const;
  void observe();
  void end(Ending ending, double time);

  SimulationOptions options_;
  Plant plant_;
  std::shared_ptr<WholeBodyController> controller_;
  std::unique_ptr<Supervisor> supervisor_;
  Robot world_;                  // as it is
  std::unique_ptr<Robot> seen_;  // as sensed; null where that is as it is
  int substeps_ = 1;             // of the plant in a tick
  PowerMeter power_meter_;
  Battery battery_;
  Sensors sensors_;
  Monitors monitors_;
  LimitMonitor limit_monitor_;
  FallMonitor fall_monitor_;
  // What is measured at the robot as it is, is measured when somebody looks: these change then.
  mutable RunRecord record_;
  mutable MeasuredTasks measured_;
  mutable bool base_fresh_ = false;  // the support is noted as it stands now
  ObstacleSight obstacles_;
  Vector initial_qpos_;             // (nq)
  Vector seen_qpos_, seen_qvel_;    // (nq), (nv) as sensed
  Vector true_qvel_;                // (nv) when they were
  Vector summed_;                   // (k) the supervisor's command and somebody else's
  Vector wished_;                   // [rad] (n) q* if the motors had held it
  SensorMonitor::Finding finding_;  // why it is held
  std::int64_t held_ticks_ = 0;
  Frame support_;
  std::optional<Frame> fall_frame_, target_;
  std::unique_ptr<Robot> placed_;  // without physics: where it moves to
  bool data_seen_ = true;          // somebody may look into its mjData
  std::size_t state_size_ = 0;
  double identity_ = 0.0;
  std::int64_t ticks_ = 0;
  Ending ending_ = Ending::Running;
  double ending_time_ = 0.0;     // [s]
  std::optional<double> heard_;  // [s] the last heartbeat, none: there was none
};

}  // namespace hurcules
