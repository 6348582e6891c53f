// A task whose value is a list of numbers: the common part of all but gaze, orientation and limits.
//
//   e = s - s_des (m), angles wrapped to [-pi, pi]
//   hold: s_des = s;   advance: s_des += velocity dt
#pragma once

#include "hurcules/tasks/max_lead.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

class ValueTask : public Task {
 public:
  void update(const Robot& robot) override;
  void hold(const Robot& robot) override;
  void advance(const ConstVectorRef& velocity, double dt) override;
  void back_calculate(double share) override;
  [[nodiscard]] ConstVectorRef yielding_target() const override { return target_; }
  void lead_target(const ConstVectorRef& step, double dt) override;
  [[nodiscard]] Index target_size() const override { return rows(); }
  void assign_target(const ConstVectorRef& target) override { set_target(target); }
  // keeps `advance` from leading the target further than this from the value (Euclidean norm, task
  // unit; inf, the default: anywhere), see MaxLead
  void set_max_lead(double max_lead) { max_lead_.set(max_lead, name_); }
  [[nodiscard]] double max_lead() const { return max_lead_.value(); }
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  [[nodiscard]] const Vector& value() const { return value_; }    // s (m), at the last update
  [[nodiscard]] const Vector& target() const { return target_; }  // s_des (m)
  // at rest; seen at the next update
  void set_target(const ConstVectorRef& target);
  // where a trajectory is now: value, its velocity and its acceleration, fed forward until the next
  // call that moves the target; (m), task unit, unit/s, unit/s^2
  void set_reference(const ConstVectorRef& target, const ConstVectorRef& velocity,
                     const ConstVectorRef& acceleration);

 protected:
  // The last line of a constructor of a derived class is hold(robot).
  ValueTask(std::string name, Index rows, const Robot& robot, bool wraps = false);

  // sets value_, jacobian_ and drift_
  virtual void measure(const Robot& robot) = 0;

  Vector value_, target_;

 private:
  bool wraps_;
  MaxLead max_lead_;
};

}  // namespace hurcules
