// The closed loop of a mission: sense, kinematics, hierarchy, solve, integrate, servo, physics; one
// tick is 1 ms.
//
// The planner works on the reference, not on what was sensed: q* is integrated from the solver's
// velocities [T 4.3.7], and the robot follows by its joint servos alone. See BaseSource for where
// it thinks it stands. Where a motor would be asked for more than its peak the reference yields
// (yielding.hpp). The servos act on what the sensors say (sensors.hpp), which is the truth unless a
// model or a fault is given. Where they cannot be believed the robot is held: its reference stops,
// its brakes close. Same seed, same bits. A run that leaves the numbers' range, or falls, or is
// held, ends with a reason; it never throws.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hurcules/control/velocity_controller.hpp"
#include "hurcules/mission/mission.hpp"
#include "hurcules/sim/battery.hpp"
#include "hurcules/sim/events.hpp"
#include "hurcules/sim/monitors.hpp"
#include "hurcules/sim/physics.hpp"
#include "hurcules/sim/power_meter.hpp"
#include "hurcules/sim/recorder.hpp"
#include "hurcules/sim/sensors.hpp"
#include "hurcules/sim/servo.hpp"
#include "hurcules/sim/stage_timer.hpp"
#include "hurcules/sim/telemetry.hpp"
#include "hurcules/sim/watch.hpp"

namespace hurcules {

// Where the planner thinks that its support stands. Both are stable, also under pushes of 1.2 kN at
// the trunk. Sensed takes the give of the ground out of the hands (0.02 instead of 2.0 mm at the
// end of the stretch) but answers each push with motion (3.9 instead of 2.8 mm). Held is the
// default: the commanded motion then follows from the command alone, and the real robot cannot
// sense its place.
enum class BaseSource {
  Held,    // where it stood at the start of the mission
  Sensed,  // where it is now
};

struct SimulationOptions {
  std::uint64_t seed = 0;
  double variation = 1.0;                // scale of what differs between seeds: variation.hpp
  std::string method = "lexicographic";  // of the solver
  bool record = true;                    // keep the time series
  Clock clock = nullptr;                 // [s] for timings; null: none are taken
  BaseSource base = BaseSource::Held;
  PowerOptions power;      // what the robot takes
  BatteryOptions battery;  // from where
  SensorOptions sensors;   // ideal without models
  MonitorOptions monitors;
};

// Why a run is over.
enum class Ending { Running, Completed, Missed, TimeUp, Fell, Diverged, SolverFailed, Held };

class Simulation {
 public:
  // `data` is somebody else's, who keeps it alive, or null for data of its own
  Simulation(ModelPtr model, const std::string& mission, SimulationOptions options = {},
             mjData_* data = nullptr);

  // up to n ticks; fewer when the mission ends. command (k) [m/s] or [rad/s] each tick, null: the
  // mission's own operator
  int step(int n = 1, const Vector* command = nullptr);
  void reset(std::uint64_t seed);
  // The brake of a joint, open after reset. A joint rests behind its shut brake: the planner does
  // not know, so that a mission holds its coordinate too (JointLimits). An empty battery closes
  // all.
  void set_brake(const std::string& joint, bool closed);

  [[nodiscard]] double dt() const { return physics_.dt(); }      // [s]
  [[nodiscard]] double time() const { return telemetry_.time; }  // [s] since reset
  [[nodiscard]] Ending ending() const { return ending_; }
  [[nodiscard]] bool finished() const { return ending_ != Ending::Running; }
  [[nodiscard]] bool success() const { return ending_ == Ending::Completed; }
  [[nodiscard]] std::string reason() const;  // "" while running
  // its sensors cannot be believed: it stands behind its brakes until the run ends
  [[nodiscard]] bool held() const { return finding_.trouble != SensorWatch::Trouble::None; }
  [[nodiscard]] const Mission& mission() const { return *mission_; }
  [[nodiscard]] Vector operator_command();  // of the next tick, (k)

  // all that decides how the run goes on; any simulation of this model and mission can restore it
  [[nodiscard]] std::vector<double> state() const;
  void restore(const std::vector<double>& values);

  [[nodiscard]] const std::vector<std::string>& levels() const { return names_.levels; }
  [[nodiscard]] const Telemetry& telemetry() const { return telemetry_; }
  [[nodiscard]] const Recorder& log() const { return log_; }
  [[nodiscard]] const Recorder& timings() const { return timings_; }  // [s] a stage and tick
  // what a policy sees now: its channels and snapshot()
  [[nodiscard]] const Recorder& observation() const { return observation_; }
  [[nodiscard]] const LimitWatch& limits() const { return limit_watch_; }
  [[nodiscard]] const EventList& events() const { return events_; }
  [[nodiscard]] std::string text(const Event& event) const;
  [[nodiscard]] const Physics& physics() const { return physics_; }
  [[nodiscard]] const Battery& battery() const { return battery_; }
  [[nodiscard]] const Robot& plan() const { return plan_; }
  [[nodiscard]] const VelocityController& controller() const { return *controller_; }
  [[nodiscard]] const Sensors& sensors() const { return sensors_; }
  [[nodiscard]] const Monitors& monitors() const { return monitors_; }
  // the mission's, then the worst that the monitors saw
  [[nodiscard]] std::vector<Figure> figures() const;

 private:
  // where the telemetry keeps the levels of a stack, and the first of their task rows
  struct StackPlaces {
    std::vector<Index> level;
    std::vector<Index> first_row;
  };

  void tick(const Vector* command);
  void think(const Vector* command, StageTimer& timer);
  void sense();
  void check_sensors();
  void kinematics();
  void hierarchy(const Vector* command);
  void solve();
  void give_way();
  void integrate();
  void servo();
  void advance_physics();
  void record();
  void judge();

  void make_controllers();
  void read(const std::vector<double>& values);
  void place_scene(std::uint64_t seed);
  [[nodiscard]] StackPlaces places_of(const Stack& stack) const;
  void enter_phase();
  void sense_coordinates();
  void sense_base();
  [[nodiscard]] const Robot& seen() const { return seen_ ? *seen_ : world_; }
  void observe();
  void note_alarms();
  void note_solution();
  void note_events();
  void measure_actual();
  void copy_errors(Vector& levels, Vector& rows) const;
  void end(Ending ending, double time);

  SimulationOptions options_;
  Physics physics_;
  Robot world_;                  // as it is
  Robot plan_;                   // at the reference, standing on its support
  std::unique_ptr<Robot> seen_;  // as sensed; null where that is as it is
  std::unique_ptr<Mission> mission_;
  std::vector<std::unique_ptr<VelocityController>> controllers_;  // one for each stack
  std::vector<std::size_t> controller_of_phase_;
  std::vector<StackPlaces> places_;           // one for each stack
  VelocityController* controller_ = nullptr;  // of the present phase
  Servo servo_;
  PowerMeter power_meter_;
  Battery battery_;
  Sensors sensors_;
  Monitors monitors_;
  LimitWatch limit_watch_;
  FallWatch fall_watch_;
  TelemetryNames names_;
  Telemetry telemetry_;
  Recorder log_, timings_, observation_;
  EventList events_;
  Vector stage_seconds_;          // (kStages)
  Vector start_qpos_;             // (nq) where the plan's support stands
  Vector previous_active_;        // (n), for events
  Vector previous_alarm_;         // (Monitors::kQuantities), for events
  Vector held_back_;              // [rad] (n) how far q* yielded so far
  Vector wished_;                 // [rad] (n) q* if it had not
  Vector seen_qpos_, seen_qvel_;  // (nq), (nv) as sensed
  SensorWatch::Finding finding_;  // why it is held
  std::int64_t held_ticks_ = 0;
  Frame support_, pelvis_;
  int casualty_qpos_ = -1;  // free joint, -1 for none
  std::optional<Frame> casualty_;
  std::int64_t ticks_ = 0;
  Ending ending_ = Ending::Running;
  double ending_time_ = 0.0;  // [s]
};

}  // namespace hurcules
