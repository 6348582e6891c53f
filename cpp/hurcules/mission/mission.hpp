// A mission: a table of phases, walked through tick by tick, and the figures that tell how it went.
//
// It knows tasks, stacks and commands, not the physics: the simulation tells it what was measured,
// asks it for the stack and reports what came out. A command is a velocity in task space; the
// operator's or, in its place, somebody else's.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hurcules/mission/phase.hpp"
#include "hurcules/mission/robot_tables.hpp"

namespace hurcules {

// One task-space command: what it moves and its largest magnitude.
struct Channel {
  std::string name;
  double scale = 0.0;  // [m/s] or [rad/s]
};

// One number that the mission is judged by.
struct Figure {
  std::string name;     // with its unit: pelvis_error_m
  double value = 0.0;   // NaN: has not happened
  double thesis = 0.0;  // what the thesis reports, NaN for nothing
};

// What a mission wants to find when it starts.
struct MissionSetup {
  std::string name;
  std::string scene;         // file under models/
  std::string keyframe;      // where the robot starts
  std::string support;       // body that the robot stands on
  double max_seconds = 0.0;  // [s] the mission fails when it takes longer
  double min_height = 0.0;   // [m] of the pelvis above the support; below, the robot fell
  double max_tilt = 0.0;     // [rad] of the support against its start; above, the robot fell
  std::vector<ServoRow> servo;
};

// What came out of a tick, for the figures.
struct TickReport {
  double time = 0.0;                     // [s]
  const Eigen::VectorXi& active_limits;  // (n), -1 0 1
  double joint_error = 0.0;              // [rad] largest of all coordinates' joints
  double torque_excess = 0.0;            // [N m] worst demand so far above what a motor can give
};

class Mission {
 public:
  virtual ~Mission() = default;
  Mission(const Mission&) = delete;
  Mission& operator=(const Mission&) = delete;

  [[nodiscard]] const MissionSetup& setup() const { return setup_; }
  [[nodiscard]] const std::vector<Phase>& phases() const { return phases_; }
  [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::vector<Figure>& figures() const { return figures_; }

  // from the start: plan stands at the reference configuration, world shows the scene as it is
  void reset(const Robot& plan, const Robot& world);
  // goes to the next phase where one is over; false when the last one is
  bool select_phase(const Robot& plan, double time);
  // what the operator would command for the next dt [s], (k)
  const Vector& operator_command(double dt);
  // moves the targets by a command, each channel held to its scale, (k)
  void apply(const Robot& plan, const ConstVectorRef& command, double dt);
  // where the robot yields to a load, after the stack was measured: every target follows it by
  // this share of the way (back-calculation), so that none winds up
  void relax(double share);

  [[nodiscard]] std::size_t phase() const { return phase_; }
  [[nodiscard]] const Stack& stack() const { return phases_[phase_].stack; }
  [[nodiscard]] const Vector& command() const { return command_; }  // the last one applied, (k)

  // after each tick, with the tasks measured at the commanded motion, then at the real one
  virtual void note_commanded(const TickReport& report) = 0;
  virtual void note_measured(const TickReport& report) = 0;
  // "" when all went well, else what is missing; asked once, after the last phase
  [[nodiscard]] virtual std::string_view verdict() const = 0;

  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 protected:
  explicit Mission(MissionSetup setup) : setup_(std::move(setup)) {}
  virtual void start(const Robot& plan, const Robot& world) = 0;
  virtual void move_targets(const Robot& plan, const ConstVectorRef& command, double dt) = 0;
  // what it remembers beside tasks and figures
  virtual void save_memory(StateWriter& writer) const = 0;
  virtual void restore_memory(StateReader& reader) = 0;

  std::vector<Phase> phases_;
  std::vector<Channel> channels_;
  std::vector<Figure> figures_;
  std::vector<Task*> tasks_;  // all that have a memory

 private:
  void enter(std::size_t phase, const Robot& plan, double time);

  MissionSetup setup_;
  std::size_t phase_ = 0;
  double phase_start_ = 0.0;  // [s]
  Vector command_, operated_;
};

// A mission by name; throws Error with the names that exist.
[[nodiscard]] std::unique_ptr<Mission> make_mission(const std::string& name, const Robot& plan);
// what each mission wants, without a robot
[[nodiscard]] const MissionSetup& mission_setup(const std::string& name);
[[nodiscard]] std::vector<std::string> mission_names();

}  // namespace hurcules
