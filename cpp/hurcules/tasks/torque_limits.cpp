#include "hurcules/tasks/torque_limits.hpp"

namespace hurcules {

TorqueLimits::TorqueLimits(std::string name, const Robot& robot)
    : Task(std::move(name), robot.size(), robot), still_(Vector::Zero(robot.size())) {
  for (Index i = 0; i < robot.size(); ++i) {
    upper_[i] = robot.coordinates()[static_cast<std::size_t>(i)].max_effort;
    lower_[i] = -upper_[i];
  }
  TorqueLimits::update(robot);
}

void TorqueLimits::update(const Robot& robot) {
  require_robot(robot);
  robot.mass_matrix(jacobian_);
  robot.inverse_dynamics(still_, drift_);
  error_ = drift_;
}

void TorqueLimits::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

}  // namespace hurcules
