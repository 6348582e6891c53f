#include "hurcules/control/parking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"

namespace hurcules {

namespace {

constexpr double kGrace = 5.0;        // [s]
constexpr double kArrived = 0.004;    // [m] left of a line: stop here
constexpr double kTurned = 0.004;     // [rad] left of a turn: stop here
constexpr double kSteepest = 0.5;     // [rad] between heading and line at most
constexpr double kFade = 0.15;        // [m] before its end a line no longer steers back sideways
constexpr double kNearEnough = 0.10;  // [m] from the run-in's start: no way of its own

void require_positive(double value, const char* name) {
  require(
      std::isfinite(value) && value > 0.0,
      std::string("parking: ") + name + " wants a positive number, got " + std::to_string(value));
}

}  // namespace

Parking::Parking(const ParkingOptions& options, double dt) : options_(options), dt_(dt) {
  require_positive(options.speed, "speed");
  require_positive(options.yaw_rate, "yaw_rate");
  require_positive(options.deceleration, "deceleration");
  require_positive(options.run_in, "run_in");
  require_positive(options.line_gain, "line_gain");
  require_positive(options.heading_gain, "heading_gain");
  require_positive(options.max_offset, "max_offset");
  require_positive(options.max_turn, "max_turn");
  require_positive(options.patience, "patience");
  require(std::isfinite(options.turn_centre), "parking: turn_centre wants a finite number");
  require(options.attempts > 0, "parking: attempts wants a whole number above 0");
}

void Parking::start(const PlanarPose& goal) {
  require(std::isfinite(goal.x) && std::isfinite(goal.y) && std::isfinite(goal.yaw),
          "a pose to park at wants finite x, y [m] and yaw [rad]");
  goal_ = goal;
  goal_centre_ = centre_of(goal);
  attempts_ = 0;
  line_ = {};
  begin(ParkingPhase::Face);
  line_.direction = 0.0;  // not aimed yet
}

bool Parking::under_way() const {
  return phase_ != ParkingPhase::Off && phase_ != ParkingPhase::Done &&
         phase_ != ParkingPhase::Failed;
}

DriveCommand Parking::command(const PlanarPose& measured, bool stopped) {
  if (!under_way()) return {};
  const PlanarPose centre = centre_of(measured);
  if (line_.direction == 0.0) aim(centre);
  if (ending_ && !stopped) return {};
  if (ending_) {
    switch (phase_) {
      case ParkingPhase::Face:
        begin(ParkingPhase::Approach);
        break;
      case ParkingPhase::Approach:
        begin(ParkingPhase::Align);
        break;
      case ParkingPhase::Align:
        begin(ParkingPhase::RunIn);
        line_ = {goal_centre_.x, goal_centre_.y, goal_.yaw, 1.0};
        break;
      default:
        end_run_in(centre);
    }
  }
  if (!under_way()) return {};
  if (phase_ == ParkingPhase::Face || phase_ == ParkingPhase::Align) {
    const double wanted = phase_ == ParkingPhase::Face ? line_.yaw : goal_.yaw;
    const double error = wrap_angle(wanted - centre.yaw);
    if (lost_patience(std::abs(error) / options_.yaw_rate)) return {};
    // what the next line takes out by itself is not worth a turn
    ending_ = std::abs(error) < (turning_ ? kTurned : options_.max_turn);
    turning_ = !ending_;
    return ending_ ? DriveCommand{} : turn(error);
  }
  if (lost_patience(std::abs(remaining(centre)) / options_.speed)) return {};
  ending_ = remaining(centre) < kArrived;
  return ending_ ? DriveCommand{} : follow(centre);
}

void Parking::begin(ParkingPhase phase) {
  phase_ = phase;
  ending_ = turning_ = false;
  left_ = -1.0;
}

bool Parking::lost_patience(double seconds) {
  if (left_ < 0.0) left_ = options_.patience * seconds + kGrace;
  left_ -= dt_;
  if (left_ > 0.0) return false;
  begin(ParkingPhase::Failed);
  return true;
}

// the line to where the run-in starts, in reverse when that place lies behind
void Parking::aim(const PlanarPose& centre) {
  line_.x = goal_centre_.x - options_.run_in * std::cos(goal_.yaw);
  line_.y = goal_centre_.y - options_.run_in * std::sin(goal_.yaw);
  const double bearing = std::atan2(line_.y - centre.y, line_.x - centre.x);
  const bool behind = std::abs(wrap_angle(bearing - centre.yaw)) > std::numbers::pi / 2.0;
  line_.direction = behind ? -1.0 : 1.0;
  line_.yaw = behind ? bearing + std::numbers::pi : bearing;
  if (std::hypot(line_.x - centre.x, line_.y - centre.y) < kNearEnough) begin(ParkingPhase::Align);
}

void Parking::end_run_in(const PlanarPose& centre) {
  const double offset = std::hypot(goal_centre_.x - centre.x, goal_centre_.y - centre.y);
  const double turned = std::abs(wrap_angle(goal_.yaw - centre.yaw));
  ++attempts_;
  if (offset <= options_.max_offset && turned <= options_.max_turn) {
    begin(ParkingPhase::Done);
  } else if (attempts_ >= options_.attempts) {
    begin(ParkingPhase::Failed);
  } else {
    // back along the goal's line, then once more
    begin(ParkingPhase::Approach);
    line_ = {goal_centre_.x - options_.run_in * std::cos(goal_.yaw),
             goal_centre_.y - options_.run_in * std::sin(goal_.yaw), goal_.yaw, -1.0};
  }
}

PlanarPose Parking::centre_of(const PlanarPose& pose) const {
  return {pose.x + options_.turn_centre * std::cos(pose.yaw),
          pose.y + options_.turn_centre * std::sin(pose.yaw), pose.yaw};
}

DriveCommand Parking::turn(double error) const {
  return {0.0, std::clamp(options_.heading_gain * error, -options_.yaw_rate, options_.yaw_rate)};
}

double Parking::remaining(const PlanarPose& centre) const {
  return line_.direction *
         (std::cos(line_.yaw) * (line_.x - centre.x) + std::sin(line_.yaw) * (line_.y - centre.y));
}

DriveCommand Parking::follow(const PlanarPose& centre) const {
  const double left = remaining(centre);
  const double offset =
      std::cos(line_.yaw) * (centre.y - line_.y) - std::sin(line_.yaw) * (centre.x - line_.x);
  const double gain = options_.line_gain * std::min(1.0, left / kFade);
  const double lean = std::clamp(std::atan(gain * offset), -kSteepest, kSteepest);
  const double error = wrap_angle(line_.yaw - line_.direction * lean - centre.yaw);
  const double speed =
      std::min({options_.speed, std::sqrt(2.0 * options_.deceleration * left), 1.5 * left + 0.01});
  return {line_.direction * speed, turn(error).yaw_rate};
}

void Parking::save(StateWriter& writer) const {
  for (const double value : {static_cast<double>(phase_), goal_.x, goal_.y, goal_.yaw, line_.x,
                             line_.y, line_.yaw, line_.direction, static_cast<double>(attempts_),
                             left_, ending_ ? 1.0 : 0.0, turning_ ? 1.0 : 0.0}) {
    writer.put(value);
  }
}

void Parking::restore(StateReader& reader) {
  phase_ = static_cast<ParkingPhase>(reader.get_count(static_cast<Index>(ParkingPhase::Failed)));
  for (double* value :
       {&goal_.x, &goal_.y, &goal_.yaw, &line_.x, &line_.y, &line_.yaw, &line_.direction}) {
    *value = reader.get();
  }
  goal_centre_ = centre_of(goal_);
  attempts_ = static_cast<int>(reader.get_count(options_.attempts));
  left_ = reader.get();
  ending_ = reader.get_count(1) > 0;
  turning_ = reader.get_count(1) > 0;
}

}  // namespace hurcules
