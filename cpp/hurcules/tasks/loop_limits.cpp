#include "hurcules/tasks/loop_limits.hpp"

#include <cmath>

#include "hurcules/robot/closures.hpp"

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

const Closures::Follower& follower(const Robot& robot, Index f) {
  return robot.closures()->followers()[static_cast<std::size_t>(f)];
}

}  // namespace

LoopLimits::LoopLimits(std::string name, const Robot& robot)
    : Task(std::move(name), static_cast<Index>(limited(robot).size()), robot),
      followers_(limited(robot)) {
  for (Index row = 0; row < rows(); ++row) {
    const Closures::Follower& own = follower(robot, followers_[static_cast<std::size_t>(row)]);
    lower_[row] = own.lower;
    upper_[row] = own.upper;
  }
  LoopLimits::update(robot);
}

void LoopLimits::update(const Robot& robot) {
  require_robot(robot);
  for (Index row = 0; row < rows(); ++row) {
    const Index f = followers_[static_cast<std::size_t>(row)];
    error_[row] = robot.qpos()[follower(robot, f).qpos];
    jacobian_.row(row) = robot.closures()->share().row(f);
    drift_[row] = robot.closures()->drift()[f];
  }
}

void LoopLimits::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

std::string LoopLimits::row_name(const Robot& robot, Index row) const {
  return follower(robot, followers_[static_cast<std::size_t>(row)]).joint;
}

}  // namespace hurcules
