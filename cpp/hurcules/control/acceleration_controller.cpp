#include "hurcules/control/acceleration_controller.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/control/limit_rows.hpp"
#include "hurcules/tasks/force_task.hpp"
#include "hurcules/tasks/torque_limits.hpp"

namespace hurcules {

namespace {

// all of a dry friction is given from a wanted velocity of DryFriction::slides on; where that is
// so steep that a joint would swing, the band is wider: as a spring of stiffness k on
// the joint's inertia M it keeps k dt^2 / M below
constexpr double kSteepest = 0.05;

void check(const AccelerationControllerOptions& options) {
  const double dt = options.dt, K = options.stiffness, L = options.damping;
  require_number(std::isfinite(dt) && dt > 0.0, "dt wants a positive time [s]", dt);
  require_number(std::isfinite(K) && K >= 0.0, "stiffness wants a number >= 0 [1/s^2]", K);
  require_number(std::isfinite(L) && L > 0.0, "damping wants a positive number [1/s]", L);
  // held for dt, an acceleration turns the speed beyond L dt = 2; a third of it leaves room
  require(L * dt < 0.66 && K * dt * dt < 0.1,
          "stiffness and damping are too high for a control period of " + number_text(dt) +
              " s: damping * dt < 0.66 and stiffness * dt^2 < 0.1 are wanted, " + number_text(L) +
              " 1/s and " + number_text(K) + " 1/s^2 came");
  require(std::isfinite(options.horizon) && options.horizon >= dt,
          "horizon wants a time of at least one control period dt, else a limit is passed; got " +
              number_text(options.horizon) + " s at dt = " + number_text(dt) + " s");
  require_number(options.max_acceleration > 0.0,
                 "max_acceleration wants a positive number [rad/s^2]", options.max_acceleration);
  require_number(options.rest >= 0.0 && options.rest * dt < 0.66,
                 "rest wants a rate >= 0 [1/s], below 0.66 / dt", options.rest);
  require_number(options.return_speed > 0.0, "return_speed wants a positive number [rad/s]",
                 options.return_speed);
  require_number(options.friction >= 0.0 && options.friction <= 1.0,
                 "friction wants a share from 0 to 1", options.friction);
}

// drives give no more, whatever a limit above asks for; a free root has none, its first coordinates
void clamp_torque(const Stack& stack, Index root, VectorRef torque) {
  for (const StackLevel& level : stack.levels()) {
    for (const Task* task : level.tasks) {
      if (!dynamic_cast<const TorqueLimits*>(task)) continue;
      for (Index i = root; i < torque.size(); ++i)
        torque[i] = std::max(task->lower()[i], std::min(torque[i], task->upper()[i]));
    }
  }
}

}  // namespace

AccelerationController::AccelerationController(const Robot& robot,
                                               AccelerationControllerOptions options)
    : options_(std::move(options)),
      rates_{options_.dt, options_.horizon, kInfinity, options_.max_acceleration,
             options_.return_speed},
      rotations_(robot.rotations()),
      floating_(robot.floating()),
      own_limits_("limits", robot),
      joint_ranges_("limits of loops and balls", robot),
      problem_(robot.size()),
      contacts_(robot),
      solver_(robot.size(), options_.solver),
      scaling_(robot.size()) {
  check(options_);
  if (options_.law == Law::Arrive && !robot.floating()) probe_.emplace(robot);
  acceleration_ = braked_ = speed_ = next_ = step_ = borne_ = Vector::Zero(robot.size());
  inertia_ = Matrix::Zero(robot.size(), robot.size());
  active_limits_ = Eigen::VectorXi::Zero(robot.size());
  intervals_.resize(static_cast<std::size_t>(robot.size()));
}

bool AccelerationController::set_stack(const Stack& stack) {
  if (problem_.asked_for(stack)) return false;
  require_period(stack, options_.dt);
  const Stack completed = contacts_.completed(stack);
  problem_.set_stack(completed, options_.enforce_limits ? &own_limits_ : nullptr, &joint_ranges_,
                     contacts_.size());
  contacts_.place(problem_);
  has_zone_ = options_.law == Law::Arrive && contacts_.size() == 0;
  Index rows = 0;
  for (const Level& level : problem_.hierarchy()) rows = std::max(rows, level.rows());
  rate_ = Vector::Zero(rows);
  torque_limits_.clear();
  for (Task* const task : problem_.stack().tasks())
    if (auto* const limits = dynamic_cast<TorqueLimits*>(task)) torque_limits_.push_back(limits);
  weights_.assign(problem_.hierarchy().size(), 0.0);
  gains_ = weights_;
  changes_.set_stack(problem_.stack());
  if (has_zone_) {
    probe_->set_stack(problem_.stack());
    dead_zone_.set_stack(problem_.stack(), acceleration_.size());
  }
  active_limits_.setZero();
  const Index unknowns = acceleration_.size() + contacts_.size();
  if (solver_.unknowns() != unknowns) solver_ = Solver(unknowns, options_.solver);
  solver_.reserve(problem_.hierarchy());
  solver_.reset();
  problem_.note_asked(stack);
  return true;
}

const Vector& AccelerationController::compute(const Robot& robot) {
  measure(robot);
  return solve();
}

void AccelerationController::measure(const Robot& robot) {
  require(!stack().levels().empty(), "a controller wants a stack before it computes");
  speed_ = robot.velocity();
  braked_ = options_.rest * speed_;
  Hierarchy& hierarchy = problem_.hierarchy();
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    const StackLevel& source = stack().levels()[k];
    for (Task* task : source.tasks) task->update(robot);
    if (source.limits) {
      source.limits->update(robot);
      fill_bounds(robot, *source.limits, hierarchy[k]);
    } else {
      fill_rates(k);
    }
  }
  if (!torque_limits_
           .empty()) {  // the root of a robot that floats is one that bears nothing itself
    borne_.setZero();
    add_borne(borne_);
    for (TorqueLimits* const limits : torque_limits_) limits->bear(borne_);
  }
  if (has_zone_) {
    probe_->look_at(robot, stack());
    dead_zone_.apply(weights_, gains_, limits(), &*probe_, hierarchy);
  }
  for (std::size_t k = 0; k < hierarchy.size(); ++k) {
    if (!hierarchy[k].bounds) fill_rows(robot, stack().levels()[k], hierarchy[k]);
  }
  contacts_.fill(hierarchy);
}

const Vector& AccelerationController::solve() {
  const Index n = acceleration_.size();
  acceleration_ = solver_.solve(problem_.hierarchy()).x.head(n);  // [T 5.3.18]
  if (solver_.solution().status == SolverStatus::InvalidInput) {
    // numbers that say nothing: towards rest as fast as the acceleration limit allows
    const double a = options_.max_acceleration;
    acceleration_ = (speed_ / -options_.dt).cwiseMax(-a).cwiseMin(a);
  } else {
    // bounds hold but for rounding: hold them exactly
    if (limits()) {
      const Level& bounds = problem_.bounds();
      acceleration_ = acceleration_.cwiseMax(bounds.lower.head(n)).cwiseMin(bounds.upper.head(n));
    }
    acceleration_ -= braked_;
    contacts_.read(solver_.solution().x);
    if (has_zone_) acceleration_ += options_.damping * dead_zone_.nudge();
  }
  if (limits()) hold_within(intervals_, acceleration_);  // what rounding left
  const auto is_limit = [this](std::size_t i, bool upper) {
    return upper ? intervals_[i].upper_is_limit : intervals_[i].lower_is_limit;
  };
  find_held(solver_.solution(), problem_.bounds_level(), is_limit, active_limits_);
  if (has_zone_) dead_zone_.add_held(active_limits_);
  return acceleration_;
}

bool AccelerationController::scale_velocity(const VelocityBounds& bounds, const Vector& velocity) {
  next_ = velocity + options_.dt * acceleration_;
  if (!scaling_.apply(bounds, problem_.hierarchy(), solver_.solution().x, next_)) return false;
  const Vector& most = (limits() ? *limits() : own_limits_).max_velocity();
  next_ = next_.cwiseMax(-most).cwiseMin(most);
  // what is fed forward counts with the acceleration: at once, each tick would ask for more
  const double change = options_.max_acceleration * options_.dt;
  next_ = next_.array().max(velocity.array() - change).min(velocity.array() + change);
  acceleration_ = (next_ - velocity) / options_.dt;
  return true;
}

void AccelerationController::torque(const Robot& robot, VectorRef torque) const {
  require(!stack().levels().empty(), "a controller wants a stack before it computes");
  require(torque.size() == acceleration_.size(), "torque wants room for one number a coordinate");
  robot.inverse_dynamics(acceleration_, torque);
  add_borne(torque);
  contacts_.relieve(torque);
  add_friction(robot, torque);
  clamp_torque(stack(), robot.root_size(), torque);
}

void AccelerationController::add_borne(VectorRef torque) const {
  for (const StackLevel& level : stack().levels()) {
    for (const Task* task : level.tasks) {
      const auto* const force = dynamic_cast<const ForceTask*>(task);
      if (force && force->state() == ContactState::Contact)
        torque += force->borne() * force->jacobian().row(0).transpose();
    }
  }
}

// towards the velocity that the levels want: a joint that friction holds has none that tells where
void AccelerationController::add_friction(const Robot& robot, VectorRef torque) const {
  if (options_.friction == 0.0) return;
  const double L = options_.damping, dt = options_.dt;
  bool knows_inertia = false;
  for (Index i = 0; i < torque.size(); ++i) {
    const std::vector<DryFriction>& friction = robot.dry_friction(i);
    if (friction.empty()) continue;
    if (!knows_inertia) robot.mass_matrix(inertia_);
    knows_inertia = true;
    const double wanted = robot.velocity()[i] + acceleration_[i] / L;
    const double steepest = kSteepest * inertia_(i, i) * L / (options_.stiffness * dt * dt);
    for (const DryFriction& dry : friction) {
      const double most = options_.friction * dry.most;
      const double slope =
          std::min(most / dry.slides, steepest / static_cast<double>(friction.size()));
      torque[i] += std::clamp(wanted * slope, -most, most);
    }
  }
}

void AccelerationController::integrate(VectorRef q, VectorRef velocity) const {
  if (floating_) throw Error("integrate: no reference can lead a free root; it wants torques");
  require(q.size() == acceleration_.size() && velocity.size() == acceleration_.size(),
          "integrate wants one number for each coordinate");
  const double dt = options_.dt;
  for (Index i = 0; i < q.size(); ++i) {
    const double next = velocity[i] + acceleration_[i] * dt;
    step_[i] = 0.5 * (velocity[i] + next) * dt;  // [T 5.6.50]
    velocity[i] = next;
  }
  if (limits())
    limits()->add_held_step(rotations_, step_, q);
  else
    add_step(rotations_, step_, q);
}

void AccelerationController::reset() {
  acceleration_.setZero();
  active_limits_.setZero();
  changes_.forget();
  solver_.reset();
}

void AccelerationController::save(StateWriter& writer) const {
  writer.put(acceleration_);
  for (Index i = 0; i < active_limits_.size(); ++i) writer.put(active_limits_[i]);
  changes_.save(writer);
  solver_.save(writer);
}

void AccelerationController::restore(StateReader& reader) {
  reader.get(acceleration_);
  for (Index i = 0; i < active_limits_.size(); ++i) {
    active_limits_[i] = static_cast<int>(reader.get());
  }
  changes_.restore(reader);
  solver_.restore(reader);
}

void AccelerationController::fill_bounds(const Robot& robot, const JointLimits& limits,
                                         Level& level) {
  for (Index i = 0; i < limits.size(); ++i) {
    AccelerationInterval& interval = intervals_[static_cast<std::size_t>(i)];
    interval = acceleration_interval(limits.state(i, robot.velocity()[i]), limits.rates(i, rates_));
    level.lower[i] = interval.lower + braked_[i];
    level.upper[i] = interval.upper + braked_[i];
  }
}

// the velocities that the tasks want; those with a law of their own want none here
void AccelerationController::fill_rates(std::size_t k) {
  const StackLevel& source = stack().levels()[k];
  Level& level = problem_.hierarchy()[k];
  const double gain = options_.stiffness / options_.damping;
  double most = 0.0, brakes = 0.0;
  bool own = false;
  for (const Task* task : source.tasks) {
    own = own || task->commands_acceleration();
    if (task->commands_acceleration() || task->is_limit() || options_.law == Law::Thesis) continue;
    most = std::max(most, haste(*task, gain, options_.dt));
    brakes = std::max(brakes, braking(*task, gain, options_.dt));
  }
  weights_[k] = std::min(1.0, most);
  most = std::max(most, brakes);
  gains_[k] = gain / std::max(1.0, most);
  Index row = 0;
  for (std::size_t t = 0; t < source.tasks.size(); ++t) {
    const Task* const task = source.tasks[t];
    const Index rows = task->rows();
    level.A.block(row, 0, rows, task->jacobian().cols()) = task->jacobian();
    auto lower = level.lower.segment(row, rows), upper = level.upper.segment(row, rows);
    if (task->bounds_acceleration()) {
      lower.setConstant(-kInfinity);
      upper.setConstant(kInfinity);
    } else if (task->commands_acceleration()) {
      // an interval, as of torques, says nothing of rates
      const auto free = (task->lower().array() < task->upper().array());
      upper = free.select(Vector::Constant(rows, kInfinity), 0.0);
      lower = -upper;
    } else if (task->is_limit()) {
      limit_rates(*task, rates_, lower, upper);
    } else {
      wanted_rates(*task, gain, options_.dt, most, lower, upper);
      if (options_.law == Law::Arrive)
        changes_.limit(k, t, *task, speed_, options_.dt, lower, upper);
    }
    for (Index i = 0; i < rows; ++i) weigh_row(*task, i, level, row + i);
    row += rows;
  }
  if ((options_.law == Law::Arrive && !own) || are_limits(source))
    level.rho = regularization_at(source.rho, weights_[k]);
}

// from velocities to the accelerations that lead to them
void AccelerationController::fill_rows(const Robot& robot, const StackLevel& source, Level& level) {
  Index row = 0;
  for (const Task* task : source.tasks) {
    auto rate = rate_.head(task->rows());
    rate.noalias() = task->jacobian() * robot.velocity();
    if (task->is_limit() && !task->commands_acceleration()) {
      limit_accelerations(*task, rates_, rate, level.lower.segment(row, task->rows()),
                          level.upper.segment(row, task->rows()));
      for (Index i = 0; i < task->rows(); ++i, ++row) {
        const double held = options_.rest * rate[i] - task->drift()[i];
        const double w = task->weights()[i];
        level.lower[row] = w == 0.0 ? 0.0 : w * (level.lower[row] + held);
        level.upper[row] = w == 0.0 ? 0.0 : w * (level.upper[row] + held);
      }
      continue;
    }
    const bool own = task->commands_acceleration();
    for (Index i = 0; i < task->rows(); ++i, ++row) {
      const double held = task->acceleration_des()[i] - task->drift()[i] + options_.rest * rate[i];
      const auto wanted = [&](double side, double velocity) {
        if (std::abs(side) >= kInfinity) return side;
        const double w = task->weights()[i];
        if (w == 0.0) return 0.0;
        const double wanted_rate = velocity / w;
        return w *
               (held + (own ? side : options_.damping * (wanted_rate - rate[i])));  // [T 5.3.17]
      };
      level.lower[row] = wanted(task->lower()[i], level.lower[row]);
      level.upper[row] = wanted(task->upper()[i], level.upper[row]);
    }
  }
}

}  // namespace hurcules
