#include "hurcules/tasks/force_task.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

PositionTaskOptions along_axis(const ForceTaskOptions& options, const Robot& robot,
                               const std::string& frame, const std::string& name) {
  require(options.axis.allFinite() && options.axis.norm() > 0.0,
          "axis of force task '" + name + "' wants a finite direction, not of length 0");
  PositionTaskOptions position;
  position.axes = options.axis.normalized().transpose();
  if (options.reference == frame)
    position.axes *= robot.orientation(robot.frame(frame)).transpose();
  else
    position.reference = options.reference;
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
    : PositionTask(name, robot, frame, along_axis(options, robot, frame, name)),
      options_(options),
      axis_(1, 3),
      law_(options.gains),
      monitor_(timed(options.contact, options.gains.dt), name),
      estimate_(options.stiffness),
      borne_(options.blend, options.gains.dt, !law_.has_reference()),
      force_des_(options.force_des) {
  if (options.reference == frame) own_ = robot.frame(frame);
  check_force_gains(options.gains, options.environment, name);
  require_number(std::isfinite(options.blend) && options.blend >= 0.0,
                 "blend of force task '" + name + "' wants a time >= 0 [s]", options.blend);
  require_number(options.max_rate > 0.0 && options.max_rate * options.gains.dt < 1.0,
                 "max_rate of force task '" + name + "' wants to be positive and below 1 / dt",
                 options.max_rate);
  set_force(options.force_des);
  ForceTask::hold(robot);
}

void ForceTask::set_force(double force_des) {
  if (!(std::abs(force_des) < options_.contact.f_max))  // also a number that is none
    throw Error("force of task '" + name_ + "' wants to be below f_max, " +
                number_text(options_.contact.f_max) + " N, " + number_text(force_des) + " came");
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

Vector3 ForceTask::world_axis(const Robot& robot) const {
  const std::optional<Frame> frame = own_ ? own_ : reference_frame();
  const Vector3 axis = options_.axis.normalized();
  return frame ? Vector3(robot.orientation(*frame) * axis) : axis;
}

void ForceTask::set_filter(double seconds) {
  require(std::isfinite(seconds) && seconds >= 0.0,
          "filter of force task '" + name_ + "' wants a time of 0 or more [s]");
  filter_ = seconds;
}

void ForceTask::sense(const Robot& robot, double force) {
  if (tare_.begins() && std::isfinite(force)) reset(robot);
  force = tare_.off(force);
  if (own_) {
    ValueTask::update(robot);
    axis_ = world_axis(robot).transpose();
    turn_axes(axis_);
  }
  ValueTask::update(robot);
  const double s = value_[0], dt = options_.gains.dt;
  if (law_.commands_acceleration()) {
    rate_ = jacobian_.row(0).dot(robot.velocity());
  } else {
    rate_ = sensed_ ? (s - last_) / dt : 0.0;
  }
  last_ = s;
  sensed_ = fed_ = fresh_ = true;
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
  relief_ = now == Mode::Hold && std::isfinite(force) ? relief() : 0.0;
  target_[0] += relief_ * dt;
  wish_ = wish(now);
  if (now != mode_) {
    offset_ = now == Mode::Hold ? 0.0 : before - wish_;  // a stop is at once
    age_ = 0.0;
    entry_ = told_;
    if (now == Mode::Force) law_.reset();
  } else {
    age_ = std::min(age_ + dt, options_.blend);
  }
  if (now == Mode::Force && mode_ == Mode::Force)
    borne_.go_on(told_, force_des_, options_.contact.f_min);
  else
    borne_.begin(told_, force_des_);
  mode_ = now;
  wish_ += blended();
  show();
}

double ForceTask::share() const {
  const bool known = options_.environment > 0.0 || law_.has_reference();
  return known ? 1.0 : std::min(1.0, options_.max_rate / law_.rate(stiffness()));
}

double ForceTask::relief() const {
  const double f = monitor_.force(), most = options_.contact.f_min;
  if (monitor_.state() != ContactState::Stopped || options_.blend == 0.0) return 0.0;
  // pulled where it should press: a sensor of the wrong sign would be led into what it presses
  if (f * force_des_ < 0.0) return 0.0;
  return share() * law_.rate(1.0) * (std::clamp(f, -most, most) - f);
}

double ForceTask::borne() const {
  if (mode_ != Mode::Force || options_.blend == 0.0) return told_;
  return borne_.value(told_, force_des_, monitor_.release());
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
    case Mode::Force:
      return law_.step(law_.has_reference() ? moving : motion, force_des_ - told_, share());
    default: {
      const ForceLaw::Motion led{motion.position, moving.velocity - relief_};
      return law_.commands_acceleration() ? law_.free(led) : motion_ + relief_;
    }
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
  // stopped: only away from the contact, and from what is wanted; a tare wants rest
  const bool away = motion_ * entry_ < 0.0 && motion_ * force_des_ <= 0.0;
  if (!tare_.runs() && (mode_ != Mode::Hold || away)) return;
  target_[0] -= motion_ * dt;
  motion_ = velocity_des_[0] = 0.0;
}

void ForceTask::tare(double seconds) {
  require(std::isfinite(seconds) && seconds >= 0.0,
          "tare of force task '" + name_ + "' wants a time of 0 or more [s]");
  tare_.begin(std::max(1.0, std::round(seconds / options_.gains.dt)));
}

void ForceTask::reset(const Robot& robot) {
  monitor_.reset();
  told_ = 0.0;
  law_.reset();
  mode_ = Mode::Motion;
  fed_ = false;
  ForceTask::hold(robot);
}

void ForceTask::save(StateWriter& writer) const {
  ValueTask::save(writer);
  if (own_) save_axes(writer);
  law_.save(writer);
  monitor_.save(writer);
  estimate_.save(writer);
  tare_.save(writer);
  borne_.save(writer);
  for (const double value :
       {force_des_, enabled_ ? 1.0 : 0.0, static_cast<double>(static_cast<int>(mode_)), motion_,
        wish_, offset_, age_, entry_, told_, rate_, last_, sensed_ ? 1.0 : 0.0, fed_ ? 1.0 : 0.0,
        fresh_ ? 1.0 : 0.0}) {
    writer.put(value);
  }
}

void ForceTask::restore(StateReader& reader) {
  ValueTask::restore(reader);
  if (own_) restore_axes(reader);
  law_.restore(reader);
  monitor_.restore(reader);
  estimate_.restore(reader);
  tare_.restore(reader);
  borne_.restore(reader);
  force_des_ = reader.get();
  enabled_ = reader.get_count(1) > 0;
  mode_ = static_cast<Mode>(reader.get_count(2));
  for (double* value : {&motion_, &wish_, &offset_, &age_, &entry_, &told_, &rate_, &last_}) {
    *value = reader.get();
  }
  sensed_ = reader.get_count(1) > 0;
  fed_ = reader.get_count(1) > 0;
  fresh_ = reader.get_count(1) > 0;
}

}  // namespace hurcules
