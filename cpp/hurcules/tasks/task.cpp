#include "hurcules/tasks/task.hpp"

#include <cmath>
#include <typeinfo>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

constexpr double kLargest = 1e6;    // of a target, a speed, a weight
constexpr double kNoNumber = 1e20;  // from here on a side is infinite

}  // namespace

Task::Task(std::string name, Index rows, Index coordinates)
    : name_(std::move(name)),
      error_(Vector::Zero(rows)),
      drift_(Vector::Zero(rows)),
      velocity_des_(Vector::Zero(rows)),
      acceleration_des_(Vector::Zero(rows)),
      lower_(Vector::Zero(rows)),
      upper_(Vector::Zero(rows)),
      jacobian_(Matrix::Zero(rows, coordinates)),
      weights_(Vector::Ones(rows)),
      speed_shares_(Vector::Ones(rows)),
      identity_{.coordinates = coordinates} {}

Task::Task(std::string name, Index rows, const Robot& robot)
    : Task(std::move(name), rows, robot.size()) {
  identity_ = robot.identity();
}

void Task::set_max_speed(double speed) {
  require(speed > 0.0 && std::isfinite(speed),
          "max_speed of task '" + name_ + "' wants a positive number, got " + number_text(speed));
  max_speed_ = speed;
}

void Task::set_max_acceleration(double acceleration) {
  require(acceleration > 0.0, "max_acceleration of task '" + name_ +
                                  "' wants a positive number, inf for none, got " +
                                  number_text(acceleration));
  max_acceleration_ = acceleration;
}

void Task::set_gain(double gain) {
  set_gain(Vector::Constant(rows(), gain));
}

void Task::set_gain(const ConstVectorRef& gains) {
  require_rows(gains, "gain");
  require(gains.minCoeff() > 0.0, "gain of task '" + name_ +
                                      "' wants positive numbers [1/s], got " +
                                      number_text(gains.minCoeff()));
  gains_ = gains;
}

void Task::set_weights(const ConstVectorRef& weights) {
  require_rows(weights, "weights");
  require(weights.minCoeff() >= 0.0, "weights of task '" + name_ + "' want numbers >= 0, got " +
                                         number_text(weights.minCoeff()));
  weights_ = weights;
}

void Task::back_calculate(double /*share*/) {}

void Task::assign_target(const ConstVectorRef& /*target*/) {
  throw Error("task '" + name_ + "' has no target that numbers say");
}

ConstVectorRef Task::yielding_target() const {
  return error_.head(0);
}

void Task::lead_target(const ConstVectorRef& /*step*/, double /*dt*/) {}

void Task::save(StateWriter& writer) const {
  writer.put(error_);  // a reference that is led counts with that of the tick before
  writer.put(velocity_des_);
  writer.put(acceleration_des_);
  writer.put(lower_);
  writer.put(upper_);
}

void Task::restore(StateReader& reader) {
  for (double& error : error_) error = reader.get_any();  // where nothing could be measured
  reader.get(velocity_des_);
  reader.get(acceleration_des_);
  reader.get(lower_);
  reader.get(upper_);
}

void Task::save_settings(StateWriter& writer) const {
  writer.put(max_speed_);
  writer.put(max_acceleration_);
  writer.put(weights_);
  const bool has_gains = gains_.size() > 0;
  writer.put(has_gains ? 1.0 : 0.0);
  for (Index row = 0; row < rows(); ++row) writer.put(has_gains ? gains_[row] : 0.0);
}

void Task::restore_settings(StateReader& reader) {
  max_speed_ = reader.get();
  max_acceleration_ = reader.get();
  reader.get(weights_);
  gains_.resize(reader.get_count(1) > 0 ? rows() : 0);
  for (Index row = 0; row < rows(); ++row) {
    const double gain = reader.get();
    if (gains_.size() > 0) gains_[row] = gain;
  }
}

void Task::set_interval(const ConstVectorRef& lower, const ConstVectorRef& upper) {
  if (lower.size() != rows() || upper.size() != rows())
    throw Error("interval of task '" + name_ + "' wants " + std::to_string(rows()) + " values, " +
                std::to_string(lower.size()) + " and " + std::to_string(upper.size()) + " came");
  for (Index row = 0; row < rows(); ++row)
    if (!(lower[row] <= upper[row]))  // also for a number that is none
      throw Error("interval of task '" + name_ + "', row " + std::to_string(row) +
                  ": lower <= upper is wanted, " + number_text(lower[row]) + " and " +
                  number_text(upper[row]) + " came");
  for (Index row = 0; row < rows(); ++row)
    if (lower[row] >= kNoNumber || upper[row] <= -kNoNumber)
      throw Error("interval of task '" + name_ + "', row " + std::to_string(row) +
                  ": an interval that holds a number is wanted, " + number_text(lower[row]) +
                  " to " + number_text(upper[row]) + " came");
  lower_ = lower;
  upper_ = upper;
}

void Task::require_robot(const Robot& robot) const {
  if (robot.identity() != identity_)
    throw Error("task '" + name_ + "' was made for another robot: " + robot.differs(identity_));
}

void Task::require_time(double dt) const {
  if (!std::isfinite(dt))
    throw Error("dt of task '" + name_ + "' wants a finite time, got " + number_text(dt));
}

void Task::require_rows(const ConstVectorRef& values, const char* what) const {
  if (values.size() != rows())
    throw Error(std::string(what) + " of task '" + name_ + "' wants " + std::to_string(rows()) +
                " values, " + std::to_string(values.size()) + " came");
  require_values(values, what);
}

void Task::require_values(const ConstVectorRef& values, const char* what) const {
  if (!values.allFinite())
    hurcules::require_values(std::string(what) + " of task '" + name_ + "'", values, values.size());
  if (values.size() > 0 && values.cwiseAbs().maxCoeff() > kLargest)
    throw Error(std::string(what) + " of task '" + name_ + "' wants numbers up to 1e6, " +
                number_text(values.cwiseAbs().maxCoeff()) + " came");
}

std::unique_ptr<Task> copy_of(const Task& task) {
  std::unique_ptr<Task> copy = task.clone();
  const Task& made = *copy;
  require(typeid(made) == typeid(task),
          "the clone of task '" + task.name() +
              "' is of another class: its class wants a clone of its own");
  return copy;
}

void copy_memory(const Task& from, Task& to, std::vector<double>& scratch) {
  scratch.clear();
  StateWriter writer(scratch);
  from.save(writer);
  StateReader reader(scratch, true);
  to.restore(reader);
}

}  // namespace hurcules
