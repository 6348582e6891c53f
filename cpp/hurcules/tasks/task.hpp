// What a task is: it measures. Value against target, Jacobian, drift, and the interval it wants the
// error in.
//
//   error e(q) = s - s_des (m)  with  de/dt = J qdot - velocity_des      [T 4.3.2], its g_k
//   the wish  lower <= e <= upper  (a point: lower = upper = 0)          [T 4.3.8]
// A controller decides what to do about it; a task knows no solver. A new task holds the robot's
// present value. Every number is bounded and finite in every configuration: near a singularity a
// task's Jacobian fades instead of growing, each task says where.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

class Task {
 public:
  virtual ~Task() = default;
  Task& operator=(const Task&) = delete;
  // a copy with its own target and memory, for another controller or a look at the measured robot
  [[nodiscard]] virtual std::unique_ptr<Task> clone() const = 0;

  // measures at the robot's present configuration: error, jacobian, drift; throws Error when the
  // robot is not of the model that the task was made for
  virtual void update(const Robot& robot) = 0;
  // makes the present value the target, at rest (error becomes zero), and updates; nobody has set it
  virtual void hold(const Robot& robot) = 0;
  // the same without memory of anything before, as it was made
  virtual void reset(const Robot& robot) { hold(robot); }
  // moves the target by velocity * dt and feeds the velocity forward until the next advance or
  // hold; (m), unit/s; dt [s]. The error follows at the next update.
  virtual void advance(const ConstVectorRef& velocity, double dt) = 0;
  // moves the target by this share (0 .. 1) of its way to the value of the last update; the
  // feed-forward stays, the error follows at the next update. Nothing where there is no target.
  virtual void back_calculate(double share);
  // what of the target that moves (k): of a pose the position; none where there is nothing
  [[nodiscard]] virtual ConstVectorRef yielding_target() const;
  // moves that by a step (k) in dt [s], whose velocity is fed forward until the next advance or hold
  virtual void lead_target(const ConstVectorRef& step, double dt);
  // how many numbers say the whole target, a rotation as a rotation vector; 0: numbers do not
  [[nodiscard]] virtual Index target_size() const { return 0; }
  // sets it so, at rest; seen at the next update
  virtual void assign_target(const ConstVectorRef& target);
  // somebody has set the target (of distances: an obstacle) since it was made or held last
  [[nodiscard]] bool target_is_set() const { return target_is_set_; }
  // what must be kept between ticks: the target, the feed-forwards and the interval
  virtual void save(StateWriter& writer) const = 0;
  virtual void restore(StateReader& reader) = 0;
  // and what was set of it besides: speed, gains and weights
  void save_settings(StateWriter& writer) const;
  void restore_settings(StateReader& reader);

  // the interval that the error shall be in; (m), task unit, -inf and inf for no side
  virtual void set_interval(const ConstVectorRef& lower, const ConstVectorRef& upper);

  // [unit/s] no more than this is asked for to bring the error to its interval (Euclidean norm, or
  // each row where they stand apart); what is fed forward comes on top
  [[nodiscard]] double max_speed() const { return max_speed_; }
  void set_max_speed(double speed);  // throws Error unless positive and finite
  // [unit/s^2] what is asked for changes no faster, and brakes no harder before the interval; of
  // several rows as max_speed. inf, the default: the coordinates' limits alone
  [[nodiscard]] double max_acceleration() const { return max_acceleration_; }
  void set_max_acceleration(double acceleration);  // throws Error unless positive
  // [1/s] of this task instead of the controller's, for all rows or each (m); throws Error unless
  // positive and finite. Critically damped by accelerations up to damping / 4.
  void set_gain(double gain);
  void set_gain(const ConstVectorRef& gains);
  [[nodiscard]] double gain(Index row, double usual) const {
    return gains_.size() == 0 ? usual : gains_[row];
  }
  // What a row counts beside the others of its level, where they cannot all be met: (m), 0 for a row
  // that asks for nothing. Throws Error unless finite and >= 0. By default 1.
  void set_weights(const ConstVectorRef& weights);
  [[nodiscard]] const Vector& weights() const { return weights_; }
  // a row that has a weight and a side
  [[nodiscard]] bool asks(Index row) const {
    return weights_[row] > 0.0 && (std::isfinite(lower_[row]) || std::isfinite(upper_[row]));
  }
  // [unit] how far the error of a row is outside its interval, signed; 0 inside
  [[nodiscard]] double beyond(Index row) const {
    return error_[row] - std::min(std::max(error_[row], lower_[row]), upper_[row]);
  }
  // max_speed of a row is this share of the task's: 1 but for tasks of several units
  [[nodiscard]] double speed_share(Index row) const { return speed_shares_[row]; }

  // [unit a rad] what a coordinate moves at most of what is measured, where the rows are a part of it
  // alone; 0: the rows say it
  [[nodiscard]] virtual double lever() const { return 0.0; }

  // each row is a coordinate's own matter: one that cannot arrive does not slow down the others
  [[nodiscard]] virtual bool rows_apart() const { return false; }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Index rows() const { return error_.size(); }
  [[nodiscard]] const Vector& error() const { return error_; }                // (m)
  [[nodiscard]] const Matrix& jacobian() const { return jacobian_; }          // (m, n)
  [[nodiscard]] const Vector& drift() const { return drift_; }                // (m), Jdot qdot
  [[nodiscard]] const Vector& velocity_des() const { return velocity_des_; }  // (m)
  [[nodiscard]] const Vector& acceleration_des() const { return acceleration_des_; }  // (m)
  [[nodiscard]] const Vector& lower() const { return lower_; }  // (m), of the error
  [[nodiscard]] const Vector& upper() const { return upper_; }  // (m)
  // its interval is a limit: controllers brake before its sides as before those of joints
  // (limit_rows.hpp), and a level of such tasks alone is not regularised
  [[nodiscard]] virtual bool is_limit() const { return false; }
  // the frame in whose axes it is measured; none: the world
  [[nodiscard]] virtual std::optional<Frame> reference_frame() const { return {}; }
  // of the error: "m", "rad", "m and rad" where rows differ; "": nobody knows
  [[nodiscard]] virtual std::string unit() const { return "rad"; }
  // what a row is about, for diagnostics
  [[nodiscard]] virtual std::string row_name(const Robot& /*robot*/, Index /*row*/) const {
    return name_;
  }
  // a law of its own for controllers of acceleration:
  //   lower <= J qddot + drift - acceleration_des <= upper
  [[nodiscard]] virtual bool commands_acceleration() const { return false; }
  // a limit by that law: a controller of velocities keeps it too, by how they change
  [[nodiscard]] bool bounds_acceleration() const { return commands_acceleration() && is_limit(); }

 protected:
  Task(const Task&) = default;
  Task(std::string name, Index rows, Index coordinates);
  // the same for a task that asks only this robot, or another one of the same model
  Task(std::string name, Index rows, const Robot& robot);

  void require_robot(const Robot& robot) const;
  // throws Error unless `values` are one number a row, none larger than 1e6: what is no length and no
  // angle of a robot
  void require_rows(const ConstVectorRef& values, const char* what) const;
  void require_values(const ConstVectorRef& values, const char* what) const;  // however many
  void require_time(double dt) const;                                         // Error unless finite

  std::string name_;
  Vector error_, drift_, velocity_des_, acceleration_des_, lower_, upper_;
  Matrix jacobian_;
  bool target_is_set_ = false;
  double max_speed_ = 1.5;  // of angles [rad/s]
  double max_acceleration_ = std::numeric_limits<double>::infinity();
  Vector weights_, speed_shares_;  // (m)

 private:
  ModelIdentity identity_;
  Vector gains_;  // (m), none: the controller's
};

// its clone; throws Error where that is of another class: a derived one wants a clone of its own
[[nodiscard]] std::unique_ptr<Task> copy_of(const Task& task);
// `to`, a copy of `from` on another robot of its model, gets what `from` keeps between ticks: target,
// feed-forwards, interval; numbers that are none too. Allocates nothing once `scratch` has grown.
void copy_memory(const Task& from, Task& to, std::vector<double>& scratch);

}  // namespace hurcules
