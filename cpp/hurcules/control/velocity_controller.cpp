#include "hurcules/control/velocity_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/tasks/joint_limits.hpp"

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

void check(const VelocityControllerOptions& options) {
  require(std::isfinite(options.dt) && options.dt > 0.0, "dt wants a positive time [s]");
  require(std::isfinite(options.gain) && options.gain >= 0.0, "gain wants a number >= 0 [1/s]");
  require(std::isfinite(options.horizon) && options.horizon >= options.dt,
          "horizon wants a time of at least one control period, else a limit is passed; got " +
              std::to_string(options.horizon) + " s");
  require(options.max_acceleration > 0.0, "max_acceleration wants a positive number [rad/s^2]");
  require(options.return_speed > 0.0, "return_speed wants a positive number [rad/s]");
}

bool is_bounds(const StackLevel& level) {
  return level.tasks.size() == 1 && level.tasks.front()->bounds_coordinates();
}

Level sized_level(const StackLevel& source, Index n) {
  Index rows = 0;
  for (const Task* task : source.tasks) rows += task->rows();
  Level level;
  level.bounds = is_bounds(source);
  level.rho = level.bounds ? 0.0 : source.rho;
  level.lower = Vector::Constant(rows, -kNone);
  level.upper = Vector::Constant(rows, kNone);
  if (!level.bounds) level.A = Matrix::Zero(rows, n);
  return level;
}

// velocity that brings the error to this side of its interval; no side stays no side
double wanted_rate(double side, double error, double velocity_des, double gain) {
  if (std::abs(side) >= kInfinity) return side;
  return velocity_des + gain * (side - error);  // [T 4.3.2]
}

}  // namespace

VelocityController::VelocityController(const Robot& robot, VelocityControllerOptions options)
    : options_(std::move(options)), solver_(robot.size(), options_.solver) {
  check(options_);
  for (const Coordinate& coordinate : robot.coordinates()) {
    rate_limits_.push_back({options_.dt, options_.horizon, coordinate.max_velocity,
                            options_.max_acceleration, options_.return_speed});
  }
  velocity_ = Vector::Zero(robot.size());
  next_ = Vector::Zero(robot.size());
  active_limits_ = Eigen::VectorXi::Zero(robot.size());
  intervals_.resize(rate_limits_.size());
}

void VelocityController::set_stack(const Stack& stack) {
  const Index n = velocity_.size();
  Hierarchy hierarchy;
  const Task* bounds_task = nullptr;
  int bounds_level = -1;
  for (const StackLevel& level : stack.levels()) {
    for (const Task* task : level.tasks) {
      require(task->jacobian().cols() == n, "task '" + task->name() + "' is for " +
                                                std::to_string(task->jacobian().cols()) +
                                                " coordinates, the robot has " + std::to_string(n));
    }
    if (is_bounds(level)) {
      require(bounds_task == nullptr, "a stack wants at most one level of coordinate limits");
      require(level.tasks.front()->rows() == n,
              "task '" + level.tasks.front()->name() + "' wants one row a coordinate");
      bounds_task = level.tasks.front();
      bounds_level = static_cast<int>(hierarchy.size());
    }
    hierarchy.push_back(sized_level(level, n));
  }
  stack_ = stack;
  hierarchy_ = std::move(hierarchy);
  bounds_task_ = bounds_task;
  joint_limits_ = dynamic_cast<const JointLimits*>(bounds_task);
  bounds_level_ = bounds_level;
  active_limits_.setZero();
  solver_.reserve(hierarchy_);
  solver_.reset();
}

const Vector& VelocityController::compute(const Robot& robot) {
  measure(robot);
  return solve();
}

void VelocityController::measure(const Robot& robot) {
  for (std::size_t k = 0; k < hierarchy_.size(); ++k) {
    const StackLevel& source = stack_.levels()[k];
    for (Task* task : source.tasks) task->update(robot);
    if (hierarchy_[k].bounds) {
      fill_bounds(*source.tasks.front(), hierarchy_[k]);
    } else {
      fill_rows(source, hierarchy_[k]);
    }
  }
}

const Vector& VelocityController::solve() {
  velocity_ = solver_.solve(hierarchy_).x;  // [T 4.3.3]
  // bounds hold but for rounding: hold them exactly
  if (bounds_level_ >= 0 && solver_.solution().status != SolverStatus::InvalidInput) {
    const Level& bounds = hierarchy_[static_cast<std::size_t>(bounds_level_)];
    velocity_ = velocity_.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  }
  find_active_limits();
  return velocity_;
}

void VelocityController::integrate(VectorRef q) const {
  const Vector* const error = bounds_task_ ? &bounds_task_->error() : nullptr;
  for (Index i = 0; i < q.size(); ++i) {
    double step = velocity_[i] * options_.dt;
    if (error) {
      // inside the limits the step ends at the limit at most; outside it may only lead back
      const double to_lower = bounds_task_->lower()[i] - (*error)[i];
      const double to_upper = bounds_task_->upper()[i] - (*error)[i];
      step = std::clamp(step, std::min(to_lower, 0.0), std::max(to_upper, 0.0));
    }
    q[i] += step;
  }
}

const Vector& VelocityController::step(Robot& robot) {
  compute(robot);
  next_ = robot.configuration();
  integrate(next_);
  robot.set_configuration(next_);
  return next_;
}

void VelocityController::reset() {
  velocity_.setZero();
  active_limits_.setZero();
  solver_.reset();
}

void VelocityController::take_over(const VelocityController& previous) {
  reset();
  velocity_ = previous.velocity_;
}

void VelocityController::save(StateWriter& writer) const {
  writer.put(velocity_);
  for (Index i = 0; i < active_limits_.size(); ++i) writer.put(active_limits_[i]);
  solver_.save(writer);
}

void VelocityController::restore(StateReader& reader) {
  reader.get(velocity_);
  for (Index i = 0; i < active_limits_.size(); ++i) {
    active_limits_[i] = static_cast<int>(reader.get());
  }
  solver_.restore(reader);
}

void VelocityController::fill_bounds(const Task& limits, Level& level) {
  for (Index i = 0; i < velocity_.size(); ++i) {
    const RateState state{limits.lower()[i] - limits.error()[i],
                          limits.upper()[i] - limits.error()[i], velocity_[i]};
    RateLimits& rates = rate_limits_[static_cast<std::size_t>(i)];
    if (joint_limits_) rates.max_velocity = joint_limits_->max_velocity()[i];
    RateInterval& interval = intervals_[static_cast<std::size_t>(i)];
    interval = rate_interval(state, rates);
    level.lower[i] = interval.lower;
    level.upper[i] = interval.upper;
  }
}

void VelocityController::fill_rows(const StackLevel& source, Level& level) const {
  Index row = 0;
  for (const Task* task : source.tasks) {
    level.A.middleRows(row, task->rows()) = task->jacobian();
    for (Index i = 0; i < task->rows(); ++i, ++row) {
      const double error = task->error()[i];
      const double velocity_des = task->velocity_des()[i];
      level.lower[row] = wanted_rate(task->lower()[i], error, velocity_des, options_.gain);
      level.upper[row] = wanted_rate(task->upper()[i], error, velocity_des, options_.gain);
    }
  }
}

void VelocityController::find_active_limits() {
  active_limits_.setZero();
  for (const ActiveRow& active : solver_.solution().working_set) {
    if (active.level != bounds_level_) continue;
    const RateInterval& interval = intervals_[static_cast<std::size_t>(active.row)];
    const bool upper = active.side == Side::Upper;
    if (upper ? interval.upper_is_limit : interval.lower_is_limit) {
      active_limits_[active.row] = upper ? 1 : -1;
    }
  }
}

}  // namespace hurcules
