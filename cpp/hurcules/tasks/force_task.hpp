// The contact force along one axis, as a row of a stack: joint < {hpos, force} < ...  [T §5.6.1]
//
// In the air it is a position task of one row: e = s - s_des, s = axis . p_RF. In contact a force
// law moves the same row (force_law.hpp); f is what the robot exerts on the environment along the
// axis, so pressing down with 5 N is -5 N along z [T 5.4.27]. The row never comes or goes: what
// changes is what it asks for, and it goes over from the speed that the frame has within the blend
// time, so that no joint speed jumps as in [T Fig. 5.17]; with blend = 0 it jumps. What still presses
// on fades with the force that is missing too: on hard ground a blend is no impact of its own. When
// f_max is passed or the sensor is lost the row holds its place until reset, and lets itself be led away from
// the contact only; the mission decides what else stops. As long as it reads more than f_min there, it gives way
// with the law's compliance: a servo with an integral would press on, ever harder. With blend = 0 it
// holds, as in the thesis.
//
// Each tick: sense(robot, f), then the controller; for a whole-body controller a tick without it is a
// missing reading, once there was one. FirstOrder is a row for both controllers, the
// other laws for one of accelerations.
#pragma once

#include <utility>

#include "hurcules/tasks/borne_force.hpp"
#include "hurcules/tasks/contact_monitor.hpp"
#include "hurcules/tasks/force_law.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/stiffness_estimate.hpp"
#include "hurcules/tasks/tare.hpp"

namespace hurcules {

struct ForceTaskOptions {
  // frame that the axis belongs to, "" = the world; the task's own frame: the axis turns with it, over
  // a curved surface, and the value counts the way along it
  std::string reference = "";
  Vector3 axis = Vector3::UnitZ();  // made a unit vector
  double force_des = -5.0;          // [N] f_d [T §5.6.2]
  double blend = 0.1;               // [s] from motion to force and back; 0: at once
  double environment = 0.0;         // [N/m] G where it is known; 0: learnt in contact
  double max_rate = 50.0;           // [1/s] where G is learnt, the compliance is held so low that a
                                    // force error vanishes no faster
  ForceGains gains = {};            // their dt holds for all of the task
  ContactOptions contact = {};      // its dt is not read
  StiffnessOptions stiffness = {};  // of the estimate
};

class ForceTask : public PositionTask {
 public:
  // throws Error for gains that are unstable with this environment
  ForceTask(std::string name, const Robot& robot, const std::string& frame,
            const ForceTaskOptions& options = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<ForceTask>(*this);
  }

  // one tick: the reading f [N] (NaN: none), the robot where the controller will see it
  void sense(const Robot& robot, double force);
  void update(const Robot& robot) override;
  void hold(const Robot& robot) override;
  // moves the motion reference along the axis; the laws without one ignore it in contact
  void advance(const ConstVectorRef& velocity, double dt) override;
  [[nodiscard]] bool commands_acceleration() const override { return law_.commands_acceleration(); }
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  void set_force(double force_des);  // [N] f_d
  // false: motion alone, whatever is read; readings are still watched
  void enable(bool on) { enabled_ = on; }
  // time constant [s] of a low-pass of what the force law is told, 0: none; contact is judged by the
  // reading itself. Throws Error unless it is finite and >= 0
  void set_filter(double seconds);
  // The mean of what is read for so long [s] (0: of one reading) is zero from then on: tare.hpp. Until
  // then readings count as none, and it stays; a contact ends. Throws Error unless it is finite and
  // >= 0
  void tare(double seconds = 0.1);
  void restart_tare() { tare_.restart(); }
  // out of Stopped and SensorLost, at rest where the frame is; the tare stays
  void reset(const Robot& robot) override;

  [[nodiscard]] bool is_told() const { return fed_; }  // of a force, since the last reset
  // whether it was told one since this was asked last
  [[nodiscard]] bool take_reading() { return std::exchange(fresh_, false); }
  [[nodiscard]] ContactState state() const { return monitor_.state(); }
  [[nodiscard]] double force() const { return monitor_.force(); }  // [N] last reading
  [[nodiscard]] double force_des() const { return force_des_; }    // [N]
  // [N] what torques bear of the contact: the reading; under force control with a blend that of
  // borne_force.hpp
  [[nodiscard]] double borne() const;
  [[nodiscard]] double stiffness() const;  // [N/m] given or learnt
  [[nodiscard]] const ForceTaskOptions& options() const { return options_; }
  [[nodiscard]] Vector3 world_axis(const Robot& robot) const;  // the axis now, in W

 private:
  enum class Mode { Motion, Force, Hold };
  [[nodiscard]] Mode mode() const;
  [[nodiscard]] double wish(Mode mode);  // of the row, without the blend
  [[nodiscard]] double blended() const;  // what the blend adds
  [[nodiscard]] double relief() const;   // [m/s] away from what is pressed while stopped
  // 0 to 1, of the compliance: a force error vanishes no faster than max_rate where G is learnt
  [[nodiscard]] double share() const;
  void show();  // the row as the controller sees it

  ForceTaskOptions options_;
  std::optional<Frame> own_;  // frame with which the axis turns
  Matrix axis_;               // (1, 3) scratch, in W
  ForceLaw law_;
  ContactMonitor monitor_;
  StiffnessEstimate estimate_;
  Tare tare_;
  BorneForce borne_;
  double force_des_;
  bool enabled_ = true;
  Mode mode_ = Mode::Motion;
  double motion_ = 0.0;  // [m/s] of the reference
  double relief_ = 0.0;  // [m/s] of this tick
  double wish_ = 0.0;    // [m/s] or [m/s^2], blend included
  double offset_ = 0.0, age_ = 0.0;
  double entry_ = 0.0;   // [N] read when the mode changed
  double filter_ = 0.0;  // [s]
  double told_ = 0.0;    // [N] filtered
  double rate_ = 0.0;    // [m/s] of the frame, by the robot's velocity or by differences
  double last_ = 0.0;    // [m] s at the last sense
  bool sensed_ = false;  // since the last hold
  bool fed_ = false, fresh_ = false;
};

}  // namespace hurcules
