// What a task is: it measures. Value against target, Jacobian, drift, and the interval it wants the error in.
//
// error e(q) (m) with  de/dt = J qdot - velocity_des  and the wish  lower <= e <= upper  (a point: lower = upper = 0).
// A controller decides what to do about it; a task knows no solver.
#pragma once

#include <string>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

class Task {
 public:
  virtual ~Task() = default;
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  // measures at the robot's present configuration: error, jacobian, drift
  virtual void update(const Robot& robot) = 0;
  // makes the present value the target (error becomes zero)
  virtual void hold(const Robot& robot) = 0;
  // moves the target by velocity * dt and feeds the velocity forward until the next advance; (m), unit/s
  virtual void advance(const ConstVectorRef& velocity, double dt) = 0;
  // what must be kept between ticks: the target and the feed-forward
  virtual void save(StateWriter& writer) const = 0;
  virtual void restore(StateReader& reader) = 0;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Index rows() const { return error_.size(); }
  [[nodiscard]] const Vector& error() const { return error_; }                // (m), s - s_des  [T 4.3.2]
  [[nodiscard]] const Matrix& jacobian() const { return jacobian_; }          // (m, n)
  [[nodiscard]] const Vector& drift() const { return drift_; }                // (m), Jdot qdot
  [[nodiscard]] const Vector& velocity_des() const { return velocity_des_; }  // (m)
  [[nodiscard]] const Vector& lower() const { return lower_; }                // (m), of the error
  [[nodiscard]] const Vector& upper() const { return upper_; }                // (m)
  // limits of the coordinates themselves: J is the identity, the solver takes them as simple bounds
  [[nodiscard]] virtual bool bounds_coordinates() const { return false; }

 protected:
  Task(std::string name, Index rows, Index coordinates);

  std::string name_;
  Vector error_, drift_, velocity_des_, lower_, upper_;
  Matrix jacobian_;
};

}  // namespace hurcules
