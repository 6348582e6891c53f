#include "hurcules/tasks/joint_ranges.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "hurcules/base/pose.hpp"
#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/coordinates.hpp"

namespace hurcules {

namespace {

std::vector<Index> limited(const Robot& robot) {
  std::vector<Index> found;
  const Closures* const loops = robot.closures();
  for (Index f = 0; loops && f < loops->size(); ++f) {
    const Closures::Follower& follower = loops->followers()[static_cast<std::size_t>(f)];
    if (std::isfinite(follower.lower) || std::isfinite(follower.upper)) found.push_back(f);
  }
  return found;
}

// a turn is pi at most: a wider range is none
std::vector<RotationVector> limited_balls(const Robot& robot) {
  std::vector<RotationVector> found;
  for (const RotationVector& rotation : robot.rotations())
    if (rotation.range < std::numbers::pi) found.push_back(rotation);
  return found;
}

const Closures::Follower& follower(const Robot& robot, Index f) {
  return robot.closures()->followers()[static_cast<std::size_t>(f)];
}

}  // namespace

JointRanges::JointRanges(std::string name, const Robot& robot)
    : Task(std::move(name), static_cast<Index>(limited(robot).size() + limited_balls(robot).size()),
           robot),
      followers_(limited(robot)),
      balls_(limited_balls(robot)) {
  Index row = 0;
  for (const Index f : followers_) {
    lower_[row] = follower(robot, f).lower;
    upper_[row++] = follower(robot, f).upper;
  }
  for (const RotationVector& ball : balls_) {
    lower_[row] = -std::numeric_limits<double>::infinity();
    upper_[row++] = 0.5 * ball.range;
  }
  JointRanges::update(robot);
}

void JointRanges::update(const Robot& robot) {
  require_robot(robot);
  Index row = 0;
  for (const Index f : followers_) {
    error_[row] = robot.qpos()[follower(robot, f).qpos];
    jacobian_.row(row) = robot.closures()->share().row(f);
    drift_[row++] = robot.closures()->drift()[f];
  }
  for (const RotationVector& ball : balls_) update_ball(robot, row++, ball);
}

void JointRanges::update_ball(const Robot& robot, Index row, const RotationVector& ball) {
  const Vector3 r = robot.configuration().segment<3>(ball.first);
  const Vector3 w = robot.velocity().segment<3>(ball.first);
  error_[row] = r.squaredNorm() / (2.0 * ball.range);
  jacobian_.row(row).segment<3>(ball.first) = r.transpose() / ball.range;  // r' rdot = r' w
  drift_[row] = w.dot(right_jacobian_inverse(r) * w) / ball.range;
}

void JointRanges::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

std::string JointRanges::row_name(const Robot& robot, Index row) const {
  const auto i = static_cast<std::size_t>(row);
  if (i < followers_.size()) return follower(robot, followers_[i]).joint;
  return joint_name(*robot.model(), balls_[i - followers_.size()].joint);
}

}  // namespace hurcules
