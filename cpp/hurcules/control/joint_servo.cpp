#include "hurcules/control/joint_servo.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/left_out.hpp"
#include "hurcules/robot/loose_joints.hpp"

namespace hurcules {

namespace {

// of the peak that a reference may ask for: rounding carries it no further
constexpr double kOfPeak = 1.0 - 1e-12;
constexpr double kBandwidth = 30.0;  // [rad/s]
constexpr int kSamples = 32;         // of the ranges
// the fastest pole of a loop is about 3 omega J_rated / J; times dt it stays below this
constexpr double kFastest = 0.5;
constexpr double kRolling = 3.0;  // times the rated inertia: a third of what a triple pole bears

const ServoGains& row_of(const std::vector<ServoGains>& table, const std::string& joint) {
  std::vector<std::string> names;
  for (const ServoGains& row : table) {
    if (row.joint == joint) return row;
    names.push_back(row.joint);
  }
  throw Error(unknown_name("servo of joint", joint, names));
}

constexpr double kOpen = 1e-9;  // [m] or [rad] of a loop

bool follows(const Robot& robot, const JointActuator& actuator) {
  const Closures* const loops = robot.closures();
  for (Index f = 0; loops && f < loops->size(); ++f)
    if (loops->dof(f) == actuator.dof) return true;
  return false;
}

// what of a range the actuator's controls can give
EffortRange within(const EffortRange& range, const JointActuator& actuator,
                   const RobotState& state) {
  const EffortRange own = actuator.efforts(actuator.position(state.qpos), state.qvel[actuator.dof]);
  return {std::clamp(own.lower, range.lower, range.upper),
          std::clamp(own.upper, range.lower, range.upper)};
}

// the i-th point of an even, never repeating sequence in 0 .. 1, another one for each coordinate
double spread(int i, Index coordinate) {
  const double x =
      0.5 + 0.6180339887498949 * (i + 1) * (1.0 + 0.37 * static_cast<double>(coordinate));
  return x - std::floor(x);
}

}  // namespace

std::vector<ServoGains> default_servo_gains(const Robot& robot, double dt, bool decoupled) {
  const Index n = robot.size();
  Robot sampled(robot.model(), robot.coordinate_names());
  sampled.set_qpos(robot.qpos());
  const Vector start = sampled.configuration();
  Vector least = Vector::Constant(n, std::numeric_limits<double>::infinity());
  Vector most = Vector::Zero(n), q = start;
  Matrix M(n, n);
  const std::vector<JointActuator> actuators = joint_actuators(robot);
  std::vector<int> others;
  for (const JointActuator& actuator : actuators)
    if (coordinate_of(robot, actuator).number < 0) others.push_back(actuator.dof);
  LooseJoints loose(robot, others);
  double gain = 1.0;  // the decoupling knows of coordinates alone
  for (int i = 0; i < kSamples; ++i) {
    for (Index k = 0; k < n && i > 0; ++k) {  // the first sample is the start
      const Coordinate& c = robot.coordinates()[static_cast<std::size_t>(k)];
      const double lower = std::isfinite(c.lower) ? c.lower : start[k] - 1.0;
      const double upper = std::isfinite(c.upper) ? c.upper : start[k] + 1.0;
      q[k] = lower + spread(i, k) * (upper - lower);
    }
    sampled.set_configuration(q);
    if (sampled.closures() && sampled.closures()->error() > kOpen) {
      sampled.set_qpos(robot.qpos());  // no posture of this robot: its loops do not close
      continue;
    }
    sampled.mass_matrix(M);
    if (decoupled) gain = std::max(gain, loose.gain(sampled));
    const Matrix inverse = M.inverse();
    most = most.cwiseMax(M.diagonal());
    least = least.cwiseMin(inverse.diagonal().cwiseInverse());
  }
  std::vector<ServoGains> table;
  for (const JointActuator& actuator : actuators) {
    const auto [k, factor] = coordinate_of(robot, actuator);
    double low = actuator.least_inertia, high = actuator.most_inertia, rated = high;
    if (k >= 0) {
      const double share =
          factor * factor *
          static_cast<double>(robot.coordinates()[static_cast<std::size_t>(k)].joints.size());
      low = least[k] / share;
      high = most[k] / share;
      rated = std::sqrt(low * high);
      if (!others.empty()) low = std::min(low, actuator.least_inertia);
    }
    if (actuator.rolling_inertia > 0.0) {  // off the ground it turns itself alone
      high = std::max(high, actuator.rolling_inertia);
      rated = std::max(std::sqrt(low * high), high / kRolling);
    }
    const bool knows = decoupled && k >= 0 && std::isfinite(gain);
    const double slowest = knows ? 1.0 / gain : std::min(1.0, low / rated);
    const double bandwidth = std::min(kBandwidth, kFastest * slowest / (3.0 * dt));
    if (!(rated > 0.0 && std::isfinite(rated))) {
      throw Error("no servo can be made for joint '" + actuator.joint +
                  "': the inertia that it turns cannot be reckoned, as where a loop ties more "
                  "coordinates than it leaves free. " +
                  left_out(robot));
    }
    table.push_back({actuator.joint, rated, bandwidth});
  }
  return table;
}

std::vector<ServoGains> model_servo_gains(const std::vector<JointActuator>& actuators) {
  std::vector<ServoGains> table;
  for (const JointActuator& one : actuators)
    if (one.servo_bandwidth > 0.0)
      table.push_back({one.joint, one.servo_inertia, one.servo_bandwidth});
  return table;
}

JointServo::JointServo(const Robot& robot, const std::vector<ServoGains>& table, double dt)
    : pid_(triple_pole({}, dt)) {
  const std::vector<JointActuator> actuators = joint_actuators(robot);
  std::vector<bool> taken(actuators.size(), false);
  std::vector<JointDrive> drives;
  const auto add = [&](std::size_t i, Index coordinate, double factor) {
    const JointActuator& actuator = actuators[i];
    const ServoGains& row = row_of(table, actuator.joint);
    taken[i] = true;
    names_.push_back(actuator.joint);
    double squares = factor * factor;
    if (coordinate >= 0) {
      squares = 0.0;
      for (const DrivenJoint& joint :
           robot.coordinates()[static_cast<std::size_t>(coordinate)].joints) {
        if (joint.actuator >= 0) squares += joint.factor * joint.factor;
      }
    }
    Motor motor{actuator, coordinate, factor, factor / squares, row.inertia};
    if (coordinate >= 0) {
      for (const DryFriction& dry : robot.dry_friction(coordinate))
        motor.friction.push_back({std::abs(motor.share) * dry.most, std::abs(factor) * dry.slides});
    }
    motors_.push_back(motor);
    drives.push_back({row.inertia, row.bandwidth, actuator.limits.peak});
  };
  for (Index k = 0; k < robot.size(); ++k) {
    for (const DrivenJoint& joint : robot.coordinates()[static_cast<std::size_t>(k)].joints) {
      for (std::size_t i = 0; i < actuators.size(); ++i) {
        if (actuators[i].actuator == joint.actuator) add(i, k, joint.factor);
      }
    }
  }
  coordinate_joints_ = static_cast<Index>(motors_.size());
  for (std::size_t i = 0; i < actuators.size(); ++i) {
    if (taken[i]) continue;
    add(i, -1, 1.0);
    // of several at one joint the first bears it alone: two servos would press against each other
    const auto same = [&](const Motor& other) {
      return other.actuator.joint_id == actuators[i].joint_id &&
             other.actuator.part == actuators[i].part;
    };
    const bool second = std::any_of(motors_.begin(), motors_.end() - 1, same);
    motors_.back().idle = second || follows(robot, actuators[i]);
  }
  pid_ = JointPid(triple_pole(drives, dt));
  for (Motor& motor : motors_) {
    for (std::size_t i = 0; i < motors_.size(); ++i) {
      const JointActuator& other = motors_[i].actuator;
      if (other.joint_id == motor.actuator.joint_id && other.part >= 0)
        motor.ball[static_cast<std::size_t>(other.part - kTurns)] = static_cast<Index>(i);
    }
  }
  find_ties(*robot.model());
  error_.position = error_.velocity = position_ = velocity_ = offset_ = Vector::Zero(size());
  reference_ = seen_ = position_;
  feed_forward_ = beside_ = Vector::Zero(size());
  rests_.resize(motors_.size());
  trust_.resize(motors_.size(), Trust::All);
  left_.resize(motors_.size(), false);
  bounds_.lower = bounds_.upper = Vector::Zero(robot.size());
}

void JointServo::find_ties(const mjModel_& model) {
  const auto servo_of = [this](int joint) {
    const auto found = std::find_if(motors_.begin(), motors_.end(), [joint](const Motor& motor) {
      return motor.actuator.joint_id == joint;
    });
    return found == motors_.end() ? Index{-1} : static_cast<Index>(found - motors_.begin());
  };
  ties_.resize(motors_.size());
  for (const Coupling& coupling : find_couplings(model)) {
    for (const Coupling& one : {coupling, turned_round(coupling)}) {
      const Index leader = servo_of(one.second), follower = servo_of(one.first);
      if (leader < coordinate_joints_) continue;
      if (follower >= 0 && follower < coordinate_joints_) continue;
      ties_[static_cast<std::size_t>(leader)].push_back(
          {follower, one.first_qpos, one.slope, one.shift});
    }
  }
}

Index JointServo::find(const std::string& joint) const {
  const auto found = std::find(names_.begin(), names_.end(), joint);
  if (found == names_.end()) throw Error(unknown_name("joint with an actuator", joint, names_));
  return found - names_.begin();
}

Matrix3 JointServo::rotation(Index joint, const Vector& reference) const {
  const std::array<Index, 3>& ball = motors_[static_cast<std::size_t>(joint)].ball;
  return rotation_exp({reference[ball[0]], reference[ball[1]], reference[ball[2]]});
}

void JointServo::place(Index joint, VectorRef qpos) const {
  const JointActuator& own = actuator(joint);
  if (own.part < 0) {
    qpos[own.qpos] = position_[joint];
    for (const Tie& tie : ties(joint))
      if (tie.follower < 0) qpos[tie.qpos] = tie.slope * position_[joint] + tie.shift;
    return;
  }
  const Eigen::Quaterniond turn(rotation(joint, position_));
  qpos.segment<4>(own.qpos) << turn.w(), turn.vec();
}

void JointServo::find_position_error(const Vector& reference, double ahead, const Vector& qpos) {
  for (Index i = 0; i < size(); ++i) {
    const JointActuator& own = actuator(i);
    if (own.part < 0) {
      error_.position[i] = reference[i] - ahead * velocity_[i] - qpos[own.qpos];
    } else {  // about the axes of the body as it is
      const std::array<Index, 3>& ball = motors_[static_cast<std::size_t>(i)].ball;
      const Vector3 turn(velocity_[ball[0]], velocity_[ball[1]], velocity_[ball[2]]);
      const Matrix3 R = rotation_of(qpos.data() + own.qpos);
      const Matrix3 now = rotation(i, reference) * rotation_exp(-ahead * turn);
      error_.position[i] = rotation_log(R.transpose() * now)[own.part - kTurns];
    }
  }
}

void JointServo::follow(const Vector& q, const Vector& velocity) {
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    position_[i] = motor.factor * q[motor.coordinate] + offset_[i];
    velocity_[i] = motor.factor * velocity[motor.coordinate];
  }
}

void JointServo::move(Index joint, double position, double velocity) {
  position_[joint] = position;
  velocity_[joint] = velocity;
}

void JointServo::let_go(Index joint, double velocity, const RobotState& state) {
  constexpr double kSettled = 3.0, kStands = 0.1;  // in time constants, of the velocity
  const JointActuator& own = actuator(joint);
  const double place = own.position(state.qpos), lead = position_[joint] - place;
  const double follows = kSettled * std::abs(velocity) / pid_.options().K_P[joint];
  const bool stands = std::abs(state.qvel[own.dof]) < kStands * std::abs(velocity);
  if (lead * velocity >= 0.0 || std::abs(lead) < follows || !stands) return;
  position_[joint] = place;
  pid_.forget(joint);
}

void JointServo::release(VectorRef q, VectorRef velocity) {
  for (Index i = coordinate_joints_ - 1; i >= 0; --i) {  // the first joint of a coordinate is last
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    q[motor.coordinate] = position_[i] / motor.factor;
    velocity[motor.coordinate] = velocity_[i] / motor.factor;
  }
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    offset_[i] = position_[i] - motor.factor * q[motor.coordinate];
  }
}

void JointServo::feed_forward(const Vector& efforts, bool friction) {
  friction_ = friction;
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    feed_forward_[i] = motor.share * efforts[motor.coordinate];
  }
}

double JointServo::overcome(Index joint, const EffortRange& range) const {
  const std::vector<DryFriction>& friction = motors_[static_cast<std::size_t>(joint)].friction;
  if (!friction_ || friction.empty()) return 0.0;
  double effort = 0.0;
  for (const DryFriction& dry : friction)
    effort += dry.most * std::clamp(velocity_[joint] / dry.slides, -1.0, 1.0);
  const double asked = feed_forward_[joint] + pid_.feedback(joint, error_);
  const double peak = kOfPeak * pid_.options().max_torque[joint];
  return std::clamp(effort, std::min(0.0, std::max(range.lower, -peak) - asked),
                    std::max(0.0, std::min(range.upper, peak) - asked));
}

void JointServo::add(const Vector& efforts) {
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    pid_.add(i, motor.share * efforts[motor.coordinate]);
  }
}

void JointServo::feedback(const RobotState& state, VectorRef efforts, VectorRef acceleration) {
  efforts.setZero();
  acceleration.setZero();  // for now the rated inertia
  follow_readings(state);
  find_position_error(position_, pid_.options().dt, state.qpos);
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    const ActuatorStatus& status =
        state.actuators[static_cast<std::size_t>(motor.actuator.actuator)];
    if (status.braked || left_[static_cast<std::size_t>(i)]) continue;
    error_.velocity[i] = velocity_[i] - state.qvel[motor.actuator.dof];
    efforts[motor.coordinate] += motor.factor * pid_.feedback(i, error_);
    acceleration[motor.coordinate] += motor.factor * motor.factor * motor.inertia;
  }
  for (Index k = 0; k < efforts.size(); ++k) {
    if (acceleration[k] > 0.0) acceleration[k] = efforts[k] / acceleration[k];
  }
}

void JointServo::rated_inertia(VectorRef inertia) const {
  inertia.setZero();
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    inertia[motor.coordinate] += motor.factor * motor.factor * motor.inertia;
  }
}

double JointServo::seen_speed(Index joint, const RobotState& state) {
  const JointActuator& own = actuator(joint);
  const double place = own.position(state.qpos), speed = state.qvel[own.dof];
  const double moved = (place - seen_[joint]) / pid_.options().dt;
  seen_[joint] = place;
  if (own.part >= 0) return speed;  // its angles are no integrals of its rates
  if (speed * moved <= 0.0) return 0.0;
  return std::abs(speed) < std::abs(moved) ? speed : moved;
}

const VelocityBounds& JointServo::velocity_bounds(const Vector& q, const Vector& qd,
                                                  const RobotState& state, double most,
                                                  const Vector* growth) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  constexpr double kAtStop = 1e-3;  // [rad] or [m]
  bounds_.lower.setConstant(-kNone);
  bounds_.upper.setConstant(kNone);
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    reference_[i] = motor.factor * q[motor.coordinate] + offset_[i];
  }
  find_position_error(reference_, 0.0, state.qpos);
  for (Index i = 0; i < coordinate_joints_; ++i) {
    const double seen = seen_speed(i, state);
    if (rests_[static_cast<std::size_t>(i)].on) continue;
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    error_.velocity[i] = -state.qvel[motor.actuator.dof];
    const double peak = kOfPeak * pid_.options().max_torque[i];
    EffortRange range = within({-peak, peak}, motor.actuator, state);
    // a servo whose controls end with its joint's range has nothing to give towards that end: what it
    // lacks there may move it off its stop, and holds nobody else
    const JointActuator& own = motor.actuator;
    if (!own.is_motor && reference_[i] <= own.lower + kAtStop) range.lower = -peak;
    if (!own.is_motor && reference_[i] >= own.upper - kAtStop) range.upper = peak;
    const double beside = feed_forward_[i];
    const double grown = growth ? (*growth)[motor.coordinate] : 1.0;
    const double a = pid_.rate_at(i, error_, (range.lower - beside) / grown) / motor.factor;
    const double b = pid_.rate_at(i, error_, (range.upper - beside) / grown) / motor.factor;
    const double goes = seen / motor.factor, led = qd[motor.coordinate];
    double& lower = bounds_.lower[motor.coordinate];
    double& upper = bounds_.upper[motor.coordinate];
    lower = std::max(lower, std::min({a, b, std::max({0.0, led, goes}) + most}));
    upper = std::min(upper, std::max({a, b, std::min({0.0, led, goes}) - most}));
    if (lower > upper) lower = upper = 0.5 * (lower + upper);
  }
  return bounds_;
}

// what held its place behind a brake holds where the brake left it
void JointServo::read_brakes(const RobotState& state) {
  require(size() == 0 || !state.actuators.empty(),
          "a robot's state wants the status of its actuators");
  for (Index i = 0; i < size(); ++i) {
    const Motor& motor = motors_[static_cast<std::size_t>(i)];
    const bool shut = state.actuators[static_cast<std::size_t>(motor.actuator.actuator)].braked;
    Rest& rest = rests_[static_cast<std::size_t>(i)];
    rest = {shut, rest.on && !shut};
    if (motor.coordinate < 0 && (rest.on || rest.over || left_[static_cast<std::size_t>(i)])) {
      position_[i] = motor.actuator.position(state.qpos);
      velocity_[i] = 0.0;
    }
  }
}

void JointServo::distrust(Index joint, bool speed_too) {
  trust_[static_cast<std::size_t>(joint)] = speed_too ? Trust::None : Trust::Speed;
}

// the reference of a joint whose encoder is not believed is what it reads
void JointServo::follow_readings(const RobotState& state) {
  for (Index i = 0; i < size(); ++i) {
    const Trust trust = trust_[static_cast<std::size_t>(i)];
    if (trust == Trust::All) continue;
    velocity_[i] = trust == Trust::Speed ? 0.0 : state.qvel[actuator(i).dof];
    position_[i] = actuator(i).position(state.qpos) + pid_.options().dt * velocity_[i];
    pid_.forget(i);
  }
}

void JointServo::compute(const RobotState& state, VectorRef ctrl) {
  read_brakes(state);
  follow_readings(state);
  find_position_error(position_, pid_.options().dt, state.qpos);
  for (Index i = 0; i < size(); ++i) {
    const JointActuator& motor = motors_[static_cast<std::size_t>(i)].actuator;
    const ActuatorStatus& status = state.actuators[static_cast<std::size_t>(motor.actuator)];
    const Rest& rest = rests_[static_cast<std::size_t>(i)];
    error_.velocity[i] = velocity_[i] - state.qvel[motor.dof];
    const bool idle = motors_[static_cast<std::size_t>(i)].idle;
    const EffortRange range = rest.on || idle ? EffortRange{} : within(status.range, motor, state);
    pid_.limit(i, range);
    beside_[i] = feed_forward_[i] + overcome(i, range);
    if (rest.over) pid_.take_over(i, error_, status.brake_load - beside_[i]);
  }
  const Vector& torque = pid_.compute(error_, beside_);
  for (Index i = 0; i < size(); ++i) {
    const JointActuator& motor = motors_[static_cast<std::size_t>(i)].actuator;
    if (left_[static_cast<std::size_t>(i)]) continue;
    ctrl[motor.actuator] =
        motor.control(torque[i], motor.position(state.qpos), state.qvel[motor.dof]);
  }
}

std::vector<std::string> JointServo::at_peak() const {
  constexpr double kAbout = 0.9;  // of the peak: references are scaled to a little less
  std::vector<std::string> names;
  for (Index i = 0; i < size(); ++i) {
    if (std::abs(pid_.demand()[i]) < kAbout * pid_.options().max_torque[i]) continue;
    names.push_back("torque limit of " + names_[static_cast<std::size_t>(i)]);
  }
  return names;
}

void JointServo::forget() {
  pid_.reset();
  offset_.setZero();
}

void JointServo::reset(const Vector& qpos) {
  forget();
  for (Vector* vector : {&error_.position, &error_.velocity, &velocity_, &feed_forward_}) {
    vector->setZero();
  }
  friction_ = false;
  for (Rest& rest : rests_) rest = {};
  std::fill(trust_.begin(), trust_.end(), Trust::All);
  for (Index i = 0; i < size(); ++i) {
    seen_[i] = position_[i] = actuator(i).position(qpos);
  }
}

void JointServo::save(StateWriter& writer) const {
  pid_.save(writer);
  for (const Vector* vector : {&position_, &velocity_, &offset_, &feed_forward_, &seen_})
    writer.put(*vector);
  for (const Rest& rest : rests_) writer.put(rest.on ? 1.0 : 0.0);
}

void JointServo::restore(StateReader& reader) {
  pid_.restore(reader);
  for (Vector* vector : {&position_, &velocity_, &offset_, &feed_forward_, &seen_})
    reader.get(*vector);
  std::fill(trust_.begin(), trust_.end(), Trust::All);  // who holds the robot tells it again
  for (Rest& rest : rests_) rest = {.on = reader.get_count(1) > 0};
}

}  // namespace hurcules
