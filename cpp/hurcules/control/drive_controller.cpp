#include "hurcules/control/drive_controller.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

constexpr double kStillBelt = 0.02;   // [m/s] a belt below this stands
constexpr double kStillYaw = 0.02;    // [rad/s]
constexpr double kLearnYaw = 0.1;     // [rad/s] below it the gyro says little about the gauge
constexpr double kLearnTime = 0.5;    // [s]
constexpr double kWidestGauge = 4.0;  // times the real one
constexpr double kMostYawBias = 0.5;  // [rad/s]

void require_range(double value, const char* name, bool positive) {
  require(std::isfinite(value) && (positive ? value > 0.0 : value >= 0.0),
          std::string("drive: ") + name + " wants a number " + (positive ? "above 0" : ">= 0") +
              ", got " + std::to_string(value));
}

void check(const DriveOptions& o) {
  require_range(o.dt, "dt", true);
  require_range(o.radius, "radius", true);
  require_range(o.gauge, "gauge", true);
  require_range(o.mass, "mass", false);
  require_range(o.max_torque, "max_torque", true);
  require_range(o.max_power, "max_power", true);
  require_range(o.max_braking_power, "max_braking_power", true);
  require_range(o.max_speed, "max_speed", true);
  require_range(o.max_yaw_rate, "max_yaw_rate", true);
  require_range(o.max_sideways, "max_sideways", true);
  require_range(o.gain, "gain", true);
  require_range(o.integral_gain, "integral_gain", false);
  require_range(o.speed_gain, "speed_gain", false);
  require_range(o.yaw_gain, "yaw_gain", false);
  require_range(o.yaw_integral_gain, "yaw_integral_gain", false);
  require_range(o.slip_speed, "slip_speed", true);
  require_range(o.slip_ratio, "slip_ratio", false);
  require_range(o.standstill_time, "standstill_time", false);
  require_range(o.brake_time, "brake_time", false);
}

bool is_zero(const DriveCommand& command) {
  return command.speed == 0.0 && command.yaw_rate == 0.0;
}

bool is_finite(const DriveState& s) {
  return std::isfinite(s.left) && std::isfinite(s.right) && std::isfinite(s.yaw_rate) &&
         std::isfinite(s.speed);
}

bool is_finite(const PlanarPose& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.yaw);
}

}  // namespace

DriveController::DriveController(const DriveOptions& options)
    : options_((check(options), options)),
      parking_(options.parking, options.dt),
      speed_(options.forward, options.dt),
      yaw_rate_(options.turning, options.dt),
      gauge_(options.gauge) {}

void DriveController::drive(const DriveCommand& command) {
  require(std::isfinite(command.speed) && std::isfinite(command.yaw_rate),
          "drive wants a finite speed [m/s] and yaw rate [rad/s]");
  parking_.stop();
  command_ = command;
}

void DriveController::park(const PlanarPose& goal) {
  parking_.start(goal);
  command_ = {};
}

DriveTorques DriveController::compute(const DriveState& measured) {
  if (!is_finite(measured) || (parking_.under_way() && !is_finite(measured.pose))) {
    return {0.0, 0.0, true};
  }
  const DriveCommand command = wanted(measured);
  mind_brakes(measured, command);
  if (braked_) return hold();
  speed_.advance(command.speed);
  yaw_rate_.advance(command.yaw_rate);
  learn_gauge(measured);
  const double asked = steer(measured) * gauge_ / 2.0;
  // how fast the ground passes under the belts by turning: a gauge that was learnt elsewhere may be
  // too wide here, the real one never is
  const double turn = within_slip(asked, measured.yaw_rate * options_.gauge / 2.0,
                                  measured.yaw_rate * gauge_ / 2.0);
  // where a fast turn rests the vehicle on its outer track, that one holds the ground and the inner one
  // slips for both: then the middle of the belts is slower than the ground by what the turn slips
  const double skid =
      std::max(0.0, std::abs(turn) - std::abs(measured.yaw_rate) * options_.gauge / 2.0);
  const double go = drive_at(measured);
  const double v =
      within_slip(go, measured.speed, measured.speed - std::copysign(skid, measured.speed));
  driving_slips_ = v != go;
  turning_slips_ = turn != asked;
  Belt left = belt(v - turn, measured.left, left_integral_);
  Belt right = belt(v + turn, measured.right, right_integral_);
  // turning goes before speed here too: what one drive lacks, both give up
  const double lack = std::max({left.demand - left.upper, right.demand - right.upper, 0.0});
  const double excess = std::max({left.lower - left.demand, right.lower - right.demand, 0.0});
  const double shift = excess - lack;
  slow_down(measured, left, right);
  const DriveTorques torques = {std::clamp(left.demand + shift, left.lower, left.upper),
                                std::clamp(right.demand + shift, right.lower, right.upper), false};
  integrate(left, right, torques);
  return torques;
}

DriveCommand DriveController::wanted(const DriveState& measured) {
  const bool stopped = still_ > 0.0;
  return within_limits(
      parking_.phase() == ParkingPhase::Off ? command_ : parking_.command(measured.pose, stopped));
}

// turning goes before speed: a fast robot that is to turn slows down
DriveCommand DriveController::within_limits(DriveCommand command) const {
  const double yaw = std::clamp(command.yaw_rate, -options_.max_yaw_rate, options_.max_yaw_rate);
  const double for_belts = options_.max_speed - std::abs(yaw) * gauge_ / 2.0;
  double most = std::max(0.0, for_belts);
  if (yaw != 0.0) most = std::min(most, options_.max_sideways / std::abs(yaw));
  return {std::clamp(command.speed, -most, most), yaw};
}

void DriveController::mind_brakes(const DriveState& measured, const DriveCommand& command) {
  if (!is_zero(command)) {
    if (braked_) left_integral_ = right_integral_ = (left_integral_ + right_integral_) / 2.0;
    braked_ = false;
    still_ = 0.0;
    return;
  }
  if (braked_) {
    still_ += options_.dt;
    return;
  }
  const double belt = options_.radius * std::max(std::abs(measured.left), std::abs(measured.right));
  const bool stands = speed_.at_rest() && yaw_rate_.at_rest() && belt < kStillBelt &&
                      std::abs(measured.yaw_rate) < kStillYaw;
  still_ = stands ? still_ + options_.dt : 0.0;
  if (still_ < options_.standstill_time || parking_.under_way()) return;
  braked_ = true;
  still_ = options_.dt;
  // what the drives give now is what holds
  left_integral_ -= options_.gain * measured.left;
  right_integral_ -= options_.gain * measured.right;
}

// the drives hold their torque until the brakes are shut, and take it up again when they open
DriveTorques DriveController::hold() {
  speed_.reset();
  yaw_rate_.reset();
  yaw_integral_ = 0.0;
  driving_slips_ = turning_slips_ = false;
  const bool shut = still_ > options_.brake_time;
  return {shut ? 0.0 : left_integral_, shut ? 0.0 : right_integral_, true};
}

// least squares of B omega = belts' difference, forgetting at the rate at which turning tells. A
// turn that is held back tells it too: where tracks skid more, the belts may then differ by more.
void DriveController::learn_gauge(const DriveState& measured) {
  if (driving_slips_) return;
  const double omega = measured.yaw_rate;
  const double difference = options_.radius * (measured.right - measured.left);
  const double weight = omega * omega + kLearnYaw * kLearnYaw;
  gauge_ += options_.dt / kLearnTime * omega * (difference - gauge_ * omega) / weight;
  gauge_ = std::clamp(gauge_, options_.gauge, kWidestGauge * options_.gauge);
}

// the speed that the belts are to give so that the ground passes as is wanted
double DriveController::drive_at(const DriveState& measured) const {
  if (speed_.at_rest() && yaw_rate_.at_rest()) return 0.0;
  return speed_.speed() + options_.speed_gain * (speed_.speed() - measured.speed);
}

// the yaw rate that the belts are to give so that the gyro shows what is wanted
double DriveController::steer(const DriveState& measured) {
  const double error = yaw_rate_.speed() - measured.yaw_rate;
  if (speed_.at_rest() && yaw_rate_.at_rest()) {
    yaw_integral_ = 0.0;
    return 0.0;
  }
  if (!turning_slips_) yaw_integral_ += options_.yaw_integral_gain * error * options_.dt;
  yaw_integral_ = std::clamp(yaw_integral_, -kMostYawBias, kMostYawBias);
  return yaw_rate_.speed() + options_.yaw_gain * error + yaw_integral_;
}

// a belt that is to stand stands, whatever slides; all others lead the ground by a little at most.
// Driving and turning are held back each on its own, so that neither takes the other's share. The
// ground passes at a speed between `one` and `other`.
double DriveController::within_slip(double reference, double one, double other) const {
  if (speed_.at_rest() && yaw_rate_.at_rest()) return reference;
  const auto [low, high] = std::minmax(one, other);
  const auto slip = [this](double ground) {
    return options_.slip_speed + options_.slip_ratio * std::abs(ground);
  };
  return std::clamp(reference, low - slip(low), high + slip(high));
}

// reference: [m/s] of the belt; rate: [rad/s]
DriveController::Belt DriveController::belt(double reference, double rate, double integral) const {
  const double error = reference / options_.radius - rate;
  const double feed = options_.mass * options_.radius * speed_.acceleration() / 2.0;
  const double turning = std::max(std::abs(rate), 1e-3);
  const double driving = std::min(options_.max_torque, options_.max_power / turning);
  const double braking = std::min(options_.max_torque, options_.max_braking_power / turning);
  Belt result;
  result.upper = rate > 0.0 ? driving : braking;
  result.lower = rate < 0.0 ? -driving : -braking;
  result.change = options_.integral_gain * error * options_.dt;
  result.demand = options_.gain * error + (integral + result.change) + feed;
  return result;
}

// What both drives lack for the turn at this speed, the one that drives gives up: the vehicle slows
// down, and a slower drive of the same power has more torque.
void DriveController::slow_down(const DriveState& measured, Belt& left, Belt& right) const {
  Belt& forward = right.demand > left.demand ? right : left;
  Belt& backward = right.demand > left.demand ? left : right;
  const double most = options_.max_torque;
  if (forward.upper == most || backward.lower == -most) return;  // slower they have no more
  const double wanted = forward.demand - backward.demand;
  const double lack = std::max(0.0, wanted - (forward.upper - backward.lower));
  if (measured.left + measured.right > 0.0) {
    forward.upper = std::max(0.0, forward.upper - lack);
  } else {
    backward.lower = std::min(0.0, backward.lower + lack);
  }
}

// A drive that lacks torque keeps its integral unless the error leads back. Where both do, the
// difference still unwinds: else a vehicle short of power would keep the torques of its last turn.
void DriveController::integrate(const Belt& left, const Belt& right, const DriveTorques& given) {
  const auto held = [](const Belt& belt, double torque) {
    return torque != belt.demand && (belt.change > 0.0) == (belt.demand > 0.0);
  };
  const bool left_held = held(left, given.left), right_held = held(right, given.right);
  double left_change = left_held ? 0.0 : left.change,
         right_change = right_held ? 0.0 : right.change;
  if (const double turn = (right.change - left.change) / 2.0;
      left_held && right_held && turn * (right_integral_ - left_integral_) < 0.0) {
    left_change = -turn;
    right_change = turn;
  }
  if (left_change != 0.0)
    left_integral_ = std::clamp(left_integral_ + left_change, left.lower, left.upper);
  if (right_change != 0.0)
    right_integral_ = std::clamp(right_integral_ + right_change, right.lower, right.upper);
}

void DriveController::reset() {
  parking_.stop();
  speed_.reset();
  yaw_rate_.reset();
  command_ = {};
  left_integral_ = right_integral_ = yaw_integral_ = still_ = 0.0;
  gauge_ = options_.gauge;
  braked_ = true;
  driving_slips_ = turning_slips_ = false;
}

void DriveController::save(StateWriter& writer) const {
  parking_.save(writer);
  speed_.save(writer);
  yaw_rate_.save(writer);
  for (const double value :
       {command_.speed, command_.yaw_rate, left_integral_, right_integral_, yaw_integral_, gauge_,
        still_, braked_ ? 1.0 : 0.0, driving_slips_ ? 1.0 : 0.0, turning_slips_ ? 1.0 : 0.0}) {
    writer.put(value);
  }
}

void DriveController::restore(StateReader& reader) {
  parking_.restore(reader);
  speed_.restore(reader);
  yaw_rate_.restore(reader);
  for (double* value : {&command_.speed, &command_.yaw_rate, &left_integral_, &right_integral_,
                        &yaw_integral_, &gauge_, &still_}) {
    *value = reader.get();
  }
  braked_ = reader.get_count(1) > 0;
  driving_slips_ = reader.get_count(1) > 0;
  turning_slips_ = reader.get_count(1) > 0;
}

}  // namespace hurcules
