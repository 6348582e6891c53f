#include "hurcules/control/velocity_controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

// [s] by the law that arrives a solve may ask for what so much acceleration reaches: where it had
// the change of one period only, regularisation would damp that change and not the velocity
constexpr double kForesight = 0.05;

void check(const VelocityControllerOptions& options) {
  require_number(std::isfinite(options.dt) && options.dt > 0.0, "dt wants a positive time [s]",
                 options.dt);
  require_number(std::isfinite(options.gain) && options.gain >= 0.0,
                 "gain wants a number >= 0 [1/s]", options.gain);
  // an error that is corrected by more than itself in a period grows
  require(options.gain * options.dt <= 1.0, "gain * dt wants to be 1 at most, got " +
                                                number_text(options.gain) + " 1/s at " +
                                                std::to_string(options.dt) + " s");
  require(std::isfinite(options.horizon) && options.horizon >= options.dt,
          "horizon wants a time of at least one control period dt, else a limit is passed; got " +
              number_text(options.horizon) + " s at dt = " + number_text(options.dt) + " s");
  require_number(options.max_acceleration > 0.0,
                 "max_acceleration wants a positive number [rad/s^2]", options.max_acceleration);
  require_number(options.return_speed > 0.0, "return_speed wants a positive number [rad/s]",
                 options.return_speed);
  require_number(std::isfinite(options.transition) && options.transition >= 0.0,
                 "transition wants a time >= 0 [s]", options.transition);
}

// rows that bound accelerations: how J qdot may change in a time, from what it was at this velocity
void change_rates(const Task& task, const Vector& velocity, double time, VectorRef lower,
                  VectorRef upper) {
  lower.noalias() = task.jacobian() * velocity;
  upper = lower + time * (task.upper() - task.drift());
  lower += time * (task.lower() - task.drift());
}

// from the velocity before towards what was solved for, all joints by one share, as far as the
// limits of a period allow
void limit_change(const Vector& before, double allowed, const std::vector<RateInterval>& intervals,
                  VectorRef velocity) {
  const double wanted = (velocity - before).cwiseAbs().maxCoeff();
  if (wanted > allowed) velocity = before + allowed / wanted * (velocity - before);
  hold_within(intervals, velocity);
}

// how many levels from the first on are nothing else
std::size_t leading_limits(const StackProblem& problem) {
  const std::vector<StackLevel>& levels = problem.stack().levels();
  std::size_t count = 0;
  while (count < levels.size() && (problem.hierarchy()[count].bounds || are_limits(levels[count])))
    ++count;
  return count;
}

}  // namespace

VelocityController::VelocityController(const Robot& robot, VelocityControllerOptions options)
    : options_(std::move(options)),
      rates_{options_.dt, options_.horizon, kInfinity, options_.max_acceleration,
             options_.return_speed},
      rotations_(robot.rotations()),
      own_limits_("limits", robot),
      joint_ranges_("limits of loops and balls", robot),
      problem_(robot.size()),
      reachable_(robot.size()),
      solver_(robot.size(), options_.solver),
      scaling_(robot.size()) {
  check(options_);
  if (options_.law == Law::Arrive) probe_.emplace(robot);
  velocity_ = next_ = step_ = offset_ = Vector::Zero(robot.size());
  active_limits_ = Eigen::VectorXi::Zero(robot.size());
  intervals_.resize(static_cast<std::size_t>(robot.size()));
}

bool VelocityController::set_stack(const Stack& stack) {
  if (problem_.asked_for(stack)) return false;
  require_period(stack, options_.dt);
  for (const Task* task : stack.tasks()) {
    require(
        !task->commands_acceleration() || task->bounds_acceleration(),
        "task '" + task->name() + "' commands accelerations: it wants an acceleration controller");
  }
  problem_.set_stack(stack, options_.enforce_limits ? &own_limits_ : nullptr, &joint_ranges_);
  begin_transition();
  weights_.assign(problem_.hierarchy().size(), 0.0);
  gains_ = weights_;
  changes_.set_stack(problem_.stack());
  if (probe_) probe_->set_stack(problem_.stack());
  leading_limits_ = leading_limits(problem_);
  dead_zone_.set_stack(problem_.stack(), velocity_.size());
  active_limits_.setZero();
  Index rows = 0;
  for (const Level& level : problem_.hierarchy()) rows = std::max(rows, level.rows());
  lower_ = upper_ = Vector::Zero(rows);
  solver_.reserve(problem_.hierarchy());
  solver_.reset();
  problem_.note_asked(stack);
  return true;
}

const Vector& VelocityController::compute(const Robot& robot) {
  measure(robot);
  return solve();
}

void VelocityController::measure(const Robot& robot) {
  require(!stack().levels().empty(), "a controller wants a stack before it computes");
  Hierarchy& hierarchy = problem_.hierarchy();
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    const StackLevel& source = stack().levels()[k];
    for (Task* task : source.tasks) task->update(robot);
    if (source.limits) {
      source.limits->update(robot);
      fill_bounds(*source.limits, hierarchy[k]);
    } else {
      fill_rows(k);
    }
  }
  if (limits()) {
    reachable_.set(problem_.bounds());
    for (std::size_t k = 1; k < leading_limits_; ++k) reachable_.drop_others(hierarchy[k]);
  }
  if (options_.law == Law::Arrive) {
    probe_->look_at(robot, stack());
    dead_zone_.apply(weights_, gains_, limits(), &*probe_, hierarchy);
  }
}

const Vector& VelocityController::solve() {
  if (fading_ && age_ < 0.0) offset_ = velocity_;
  next_ = velocity_;  // scratch until the end of the period: the velocity before
  velocity_ = solver_.solve(problem_.hierarchy()).x;  // [T 4.3.3]
  const bool solved = solver_.solution().status != SolverStatus::InvalidInput;
  if (!solved) brake();
  if (fading_ && solved) add_transition();
  if (options_.law == Law::Arrive && solved) velocity_ += dead_zone_.nudge();
  // bounds hold but for rounding: hold them exactly
  if (limits() && solved) {
    const Level& bounds = problem_.bounds();
    velocity_ = velocity_.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
    if (options_.law == Law::Arrive)
      limit_change(next_, options_.max_acceleration * options_.dt, intervals_, velocity_);
    hold_limits();
  }
  const auto is_limit = [this](std::size_t i, bool upper) {
    if (options_.law == Law::Arrive) {
      const auto row = static_cast<Index>(i);
      const double most = limits()->max_velocity()[row];
      return upper ? problem_.bounds().upper[row] == intervals_[i].most && intervals_[i].most < most
                   : problem_.bounds().lower[row] == intervals_[i].least &&
                         intervals_[i].least > -most;
    }
    return upper ? intervals_[i].upper_is_limit : intervals_[i].lower_is_limit;
  };
  find_held(solver_.solution(), problem_.bounds_level(), is_limit, active_limits_);
  if (options_.law == Law::Arrive) dead_zone_.add_held(active_limits_);
  return velocity_;
}

bool VelocityController::scale_velocity(const VelocityBounds& window) {
  if (!scaling_.apply(window, problem_.hierarchy(), solver_.solution().x, velocity_)) return false;
  if (!limits()) return true;
  if (options_.law == Law::Arrive) {
    limit_change(next_, options_.max_acceleration * options_.dt, intervals_, velocity_);
    hold_limits();
  }
  for (Index i = 0; i < velocity_.size(); ++i) {
    const RateInterval& interval = intervals_[static_cast<std::size_t>(i)];
    if (window.lower[i] > 0.0) velocity_[i] = std::max(velocity_[i], window.lower[i]);
    if (window.upper[i] < 0.0) velocity_[i] = std::min(velocity_[i], window.upper[i]);
    velocity_[i] = std::clamp(velocity_[i], interval.least, interval.most);
  }
  return true;
}

void VelocityController::integrate(VectorRef q) const {
  require(q.size() == velocity_.size(), "integrate wants one number for each coordinate");
  step_ = velocity_ * options_.dt;
  if (limits())
    limits()->add_held_step(rotations_, step_, q);
  else
    add_step(rotations_, step_, q);
}

const Vector& VelocityController::step(Robot& robot) {
  compute(robot);
  next_ = robot.configuration();
  integrate(next_);
  robot.set_configuration(next_);
  return next_;
}

void VelocityController::begin_transition() {
  fading_ = options_.transition > 0.0 && (velocity_.array() != 0.0).any();
  age_ = -1.0;
}

// what is left of the velocity before, on top of what the stack asks for
void VelocityController::add_transition() {
  if (age_ < 0.0) {
    offset_ -= velocity_;
    age_ = 0.0;
  }
  const double u = age_ / options_.transition;
  velocity_ += (1.0 - u * u * (3.0 - 2.0 * u)) * offset_;
  age_ += options_.dt;
  fading_ = age_ < options_.transition;
}

std::vector<LevelDiagnostics> VelocityController::diagnostics(const Robot& robot) const {
  return level_diagnostics({robot, problem_, solver_.solution(), reports_of(solver_),
                            active_limits_, options_.law == Law::Arrive ? &dead_zone_ : nullptr});
}

void VelocityController::reset() {
  fading_ = false;
  velocity_.setZero();
  active_limits_.setZero();
  changes_.forget();
  solver_.reset();
}

void VelocityController::take_over(const Vector& velocity) {
  require_values("take_over", velocity, velocity_.size());
  reset();
  velocity_ = velocity;
  begin_transition();
}

void VelocityController::save(StateWriter& writer) const {
  writer.put(velocity_);
  writer.put(offset_);
  writer.put(age_);
  writer.put(fading_ ? 1.0 : 0.0);
  for (Index i = 0; i < active_limits_.size(); ++i) writer.put(active_limits_[i]);
  changes_.save(writer);
  solver_.save(writer);
}

void VelocityController::restore(StateReader& reader) {
  reader.get(velocity_);
  reader.get(offset_);
  age_ = reader.get();
  fading_ = reader.get_count(1) > 0;
  for (Index i = 0; i < active_limits_.size(); ++i) {
    active_limits_[i] = static_cast<int>(reader.get());
  }
  changes_.restore(reader);
  solver_.restore(reader);
}

// [s] whose acceleration a solve may ask for
double VelocityController::reach_time() const {
  return options_.law == Law::Arrive ? std::max(kForesight, options_.dt) : options_.dt;
}

void VelocityController::fill_bounds(const JointLimits& limits, Level& level) {
  for (Index i = 0; i < velocity_.size(); ++i) {
    RateInterval& interval = intervals_[static_cast<std::size_t>(i)];
    interval = rate_interval(limits.state(i, velocity_[i]), limits.rates(i, rates_));
    if (options_.law == Law::Arrive) {
      const double reach = options_.max_acceleration * reach_time();
      level.lower[i] = std::clamp(velocity_[i] - reach, interval.least, interval.most);
      level.upper[i] = std::clamp(velocity_[i] + reach, interval.least, interval.most);
    } else {
      level.lower[i] = interval.lower;
      level.upper[i] = interval.upper;
    }
  }
}

// towards rest as fast as the acceleration limit allows: for numbers that say nothing
void VelocityController::brake() {
  const double change = options_.max_acceleration * options_.dt;
  for (Index i = 0; i < velocity_.size(); ++i)
    velocity_[i] = next_[i] - std::clamp(next_[i], -change, change);
  if (limits()) hold_within(intervals_, velocity_);
}

// What limits the change of a velocity may have carried it over the limits of the first levels: the
// last of them first, so that those above have the last word.
void VelocityController::hold_limits() {
  const std::vector<StackLevel>& levels = stack().levels();
  for (std::size_t k = leading_limits_; k-- > 0;) {
    const Level& level = problem_.hierarchy()[k];
    if (level.bounds) continue;
    auto lower = lower_.head(level.rows()), upper = upper_.head(level.rows());
    lower = level.lower;
    upper = level.upper;
    Index row = 0;
    for (const Task* task : levels[k].tasks) {
      const Index rows = task->rows();
      if (task->bounds_acceleration()) {
        auto least = lower.segment(row, rows), most = upper.segment(row, rows);
        change_rates(*task, next_, options_.dt, least, most);
        for (Index i = 0; i < rows; ++i) weigh_sides(task->weights()[i], least[i], most[i]);
      }
      row += rows;
    }
    hold_rows(level.A, lower, upper, intervals_, velocity_);
  }
}

void VelocityController::fill_rows(std::size_t k) {
  const StackLevel& source = stack().levels()[k];
  Level& level = problem_.hierarchy()[k];
  double most = 0.0, brakes = 0.0;
  for (const Task* task : source.tasks) {
    if (task->is_limit() || options_.law == Law::Thesis) continue;
    most = std::max(most, haste(*task, options_.gain, options_.dt));
    brakes = std::max(brakes, braking(*task, options_.gain, options_.dt));
  }
  weights_[k] = std::min(1.0, most);
  most = std::max(most, brakes);
  gains_[k] = options_.gain / std::max(1.0, most);
  Index row = 0;
  for (std::size_t t = 0; t < source.tasks.size(); ++t) {
    const Task* const task = source.tasks[t];
    const Index rows = task->rows();
    level.A.middleRows(row, rows) = task->jacobian();
    auto lower = level.lower.segment(row, rows), upper = level.upper.segment(row, rows);
    if (task->bounds_acceleration()) {
      change_rates(*task, velocity_, reach_time(), lower, upper);
    } else if (task->is_limit()) {
      limit_rates(*task, rates_, lower, upper);
    } else {
      wanted_rates(*task, options_.gain, options_.dt, most, lower, upper);
      if (options_.law == Law::Arrive)
        changes_.limit(k, t, *task, velocity_, options_.dt, lower, upper);
    }
    for (Index i = 0; i < rows; ++i) weigh_row(*task, i, level, row + i);
    row += rows;
  }
  const bool full = options_.law == Law::Thesis && !are_limits(source);
  level.rho = full ? source.rho : regularization_at(source.rho, weights_[k]);
}

}  // namespace hurcules
