#include "hurcules/tasks/force_task.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

PositionTaskOptions along_axis(const ForceTaskOptions& options, const std::string& name) {
  require(options.axis.allFinite() && options.axis.norm() > 0.0,
          "axis of force task '" + name + "' wants a finite direction, not of length 0");
  PositionTaskOptions position;
  position.reference = options.reference;
  position.axes = options.axis.normalized().transpose();
  return position;
}

ContactOptions timed(ContactOptions contact, double dt) {
  contact.dt = dt;
  return contact;
}

// 1 at once, 0 after the blend, smooth at both ends
double fade(double age, double blend) {
  if (age >= blend) return 0.0;
  const double u = age / blend;
  return 1.0 - u * u * (3.0 - 2.0 * u);
}

}  // namespace

ForceTask::ForceTask(std::string name, const Robot& robot, const std::string& frame,
                     const ForceTaskOptions& options)
    : PositionTask(name, robot, frame, along_axis(options, name)),
      options_(options),
      law_(options.gains),
      monitor_(timed(options.contact, options.gains.dt), name),
      estimate_(options.stiffness),
      force_des_(options.force_des) {
  check_force_gains(options.gains, options.environment, name);
  require(std::isfinite(options.blend) && options.blend >= 0.0,
          "blend of force task '" + name + "' wants a time >= 0 [s]");
  require(options.max_rate > 0.0 && options.max_rate * options.gains.dt < 1.0,
          "max_rate of force task '" + name + "' wants to be positive and below 1 / dt");
  set_force(options.force_des);
  ForceTask::hold(robot);
}

void ForceTask::set_force(double force_des) {
  require(std::abs(force_des) < options_.contact.f_max,  // also for a number that is none
          "force of task '" + name_ + "' wants to be below f_max");
  force_des_ = force_des;
  monitor_.expect(force_des);
}

double ForceTask::stiffness() const {
  return options_.environment > 0.0 ? options_.environment : estimate_.value();
}

ForceTask::Mode ForceTask::mode() const {
  const ContactState state = monitor_.state();
  if (state == ContactState::Stopped || state == ContactState::SensorLost) return Mode::Hold;
  return enabled_ && state == ContactState::Contact ? Mode::Force : Mode::Motion;
}

void ForceTask::set_filter(double seconds) {
  require(std::isfinite(seconds) && seconds >= 0.0,
          "filter of force task '" + name_ + "' wants a time of 0 or more [s]");
  filter_ = seconds;
}

void ForceTask::sense(const Robot& robot, double force) {
  if (tares_ && std::isfinite(force)) {
    zero_ = force;
    tares_ = false;
    release(robot);
  }
  force -= zero_;
  ValueTask::update(robot);
  const double s = value_[0], dt = options_.gains.dt;
  if (law_.commands_acceleration()) {
    rate_ = jacobian_.row(0).dot(robot.velocity());
  } else {
    rate_ = sensed_ ? (s - last_) / dt : 0.0;
  }
  last_ = s;
  sensed_ = true;
  monitor_.look(force, s);
  const double read = monitor_.force();
  told_ = filter_ > dt ? told_ + dt / filter_ * (read - told_) : read;
  const Mode now = mode();
  if (now == Mode::Force) {
    if (mode_ != Mode::Force) estimate_.start(s, read);
    estimate_.look(s, read);
  }
  // without a reference in the law, the motion goes on from where the force left the frame
  const bool follows = now == Mode::Force && !law_.has_reference();
  if (follows || (now == Mode::Hold && mode_ != Mode::Hold)) target_[0] = s;
  if (now == Mode::Hold && mode_ != Mode::Hold) motion_ = 0.0;
  const double before = law_.commands_acceleration() ? wish_ : rate_;
  wish_ = wish(now);
  if (now != mode_) {
    offset_ = now == Mode::Hold ? 0.0 : before - wish_;  // a stop is at once
    age_ = 0.0;
    entry_ = told_;
    if (now == Mode::Force) law_.reset();
  } else {
    age_ = std::min(age_ + dt, options_.blend);
  }
  if (now != Mode::Force || options_.blend == 0.0)
    borne_ = told_;
  else if (mode_ != Mode::Force)  // no more than is wanted: an impact is not pushed on
    borne_ = std::clamp(told_, std::min(force_des_, 0.0), std::max(force_des_, 0.0));
  else
    borne_ += std::min(1.0, dt / options_.blend) * (force_des_ - borne_);
  mode_ = now;
  wish_ += blended();
  show();
}

// what is left of the way that the frame came: where it presses on, none from the wanted force on
double ForceTask::blended() const {
  const double left = offset_ * fade(age_, options_.blend);
  if (mode_ != Mode::Force || left * force_des_ <= 0.0) return left;
  const double lacked = force_des_ - entry_, lacks = force_des_ - told_;
  return lacked * force_des_ > 0.0 ? left * std::clamp(lacks / lacked, 0.0, 1.0) : 0.0;
}

double ForceTask::wish(Mode mode) {
  const ForceLaw::Motion motion{value_[0] - target_[0], rate_};
  const ForceLaw::Motion moving{motion.position, rate_ - motion_};
  switch (mode) {
    case Mode::Motion:
      return law_.commands_acceleration() ? law_.free(moving) : motion_;
    case Mode::Force: {
      const double G = stiffness(), most = options_.max_rate;
      const bool known = options_.environment > 0.0 || law_.has_reference();
      const double share = known ? 1.0 : std::min(1.0, most / law_.rate(G));
      return law_.step(law_.has_reference() ? moving : motion, force_des_ - told_, share);
    }
    default:
      return law_.commands_acceleration() ? law_.free(moving) : motion_;
  }
}

void ForceTask::show() {
  if (law_.commands_acceleration()) {
    acceleration_des_[0] = wish_;
    return;
  }
  if (mode_ == Mode::Motion) {
    velocity_des_[0] = motion_ + blended();
  } else {
    velocity_des_[0] = wish_;
    error_[0] = 0.0;  // the law alone decides
  }
}

void ForceTask::update(const Robot& robot) {
  ValueTask::update(robot);
  show();
}

void ForceTask::hold(const Robot& robot) {
  ValueTask::hold(robot);
  motion_ = wish_ = offset_ = rate_ = last_ = 0.0;
  age_ = options_.blend;
  entry_ = 0.0;
  sensed_ = false;
}

void ForceTask::advance(const ConstVectorRef& velocity, double dt) {
  ValueTask::advance(velocity, dt);
  motion_ = velocity_des_[0];
  if (mode_ != Mode::Hold || motion_ * force() < 0.0) return;
  // stopped: only away from the contact
  target_[0] -= motion_ * dt;
  motion_ = velocity_des_[0] = 0.0;
}

void ForceTask::reset(const Robot& robot) {
  zero_ = 0.0;
  tares_ = false;
  release(robot);
}

void ForceTask::release(const Robot& robot) {
  monitor_.reset();
  told_ = 0.0;
  law_.reset();
  mode_ = Mode::Motion;
  ForceTask::hold(robot);
}

void ForceTask::save(StateWriter& writer) const {
  ValueTask::save(writer);
  law_.save(writer);
  monitor_.save(writer);
  estimate_.save(writer);
  for (const double value :
       {force_des_, enabled_ ? 1.0 : 0.0, static_cast<double>(static_cast<int>(mode_)), motion_,
        wish_, offset_, age_, entry_, borne_, told_, rate_, last_, zero_, tares_ ? 1.0 : 0.0,
        sensed_ ? 1.0 : 0.0}) {
    writer.put(value);
  }
}

void ForceTask::restore(StateReader& reader) {
  ValueTask::restore(reader);
  law_.restore(reader);
  monitor_.restore(reader);
  estimate_.restore(reader);
  force_des_ = reader.get();
  enabled_ = reader.get_count(1) > 0;
  mode_ = static_cast<Mode>(reader.get_count(2));
  for (double* value :
       {&motion_, &wish_, &offset_, &age_, &entry_, &borne_, &told_, &rate_, &last_, &zero_}) {
    *value = reader.get();
  }
  tares_ = reader.get_count(1) > 0;
  sensed_ = reader.get_count(1) > 0;
}

}  // namespace hurcules
