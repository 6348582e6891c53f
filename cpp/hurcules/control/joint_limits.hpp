// The limits of all coordinates: their ranges and speeds. No task: a controller owns one, keeps it
// before all levels, and adds the accelerations of its options; a stack may name another one.
//
//   lower <= q <= upper, |qdot| <= max_velocity      (n) [rad] or [m]      [T 4.3.8]: g_joint
// The three coordinates of a ball joint have no ranges here: its angle is a row of JointRanges.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/control/rate_interval.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

class JointLimits {
 public:
  // starts with the ranges and the velocity limits of the robot, inf where it has none
  JointLimits(std::string name, const Robot& robot);

  // where the coordinates are now; throws Error for a robot of another model
  void update(const Robot& robot);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

  // a narrower range of one coordinate, for a mode of work; [rad] or [m]
  void set_range(const std::string& coordinate, double lower, double upper);
  // the ranges of the robot again
  void reset_ranges();
  // of all, (n) each; these throw Error unless within the ranges of the robot
  void set_interval(const ConstVectorRef& lower, const ConstVectorRef& upper);
  // the robot's own holds where it is smaller; inf: none at all, not the robot's either
  void set_max_velocity(const std::string& coordinate, double limit);  // [rad/s] or [m/s]
  void set_max_velocities(const ConstVectorRef& limits);               // of all, (n)

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Index size() const { return lower_.size(); }                  // n
  [[nodiscard]] const Vector& lower() const { return lower_; }                // (n)
  [[nodiscard]] const Vector& upper() const { return upper_; }                // (n)
  [[nodiscard]] const Vector& max_velocity() const { return max_velocity_; }  // (n) [rad/s]
  // (n) of the last update
  [[nodiscard]] const Vector& configuration() const { return configuration_; }
  // every range is one: not so after a restore from numbers that are none
  [[nodiscard]] bool are_numbers() const { return !lower_.hasNaN() && !upper_.hasNaN(); }

  // where a coordinate was at the last update, at this velocity
  [[nodiscard]] RateState state(Index i, double velocity) const;
  // what holds for it beside a controller's own limits; nothing limits a free root's acceleration
  [[nodiscard]] RateLimits rates(Index i, const RateLimits& controller) const;
  // a step of it from there: inside its range it ends at the limit at most, outside it may only
  // lead back
  [[nodiscard]] double held_step(Index i, double step) const;

  // q (n) a step (n) further, no coordinate and no ball joint over its limit by rounding; step: held
  void add_held_step(const std::vector<RotationVector>& rotations, Vector& step, VectorRef q) const;

 private:
  [[nodiscard]] Index index(const std::string& coordinate) const;
  void require_size(Index size, const char* what) const;
  void require_range(Index i, double lower, double upper) const;

  std::string name_;
  ModelIdentity identity_;
  std::vector<std::string> coordinates_;
  std::vector<bool> of_root_;                          // (n) a part of a free root
  std::vector<bool> of_ball_;                          // (n) a part of a ball joint
  Vector robot_lower_, robot_upper_, robot_velocity_;  // [rad] or [m], [rad/s] or [m/s], (n)
  Vector lower_, upper_, max_velocity_, configuration_;
};

}  // namespace hurcules
