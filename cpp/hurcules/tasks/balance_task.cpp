#include "hurcules/tasks/balance_task.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

constexpr double kLeastHeight = 0.05;  // [m] of the centre of mass over the polygon
constexpr double kSlowest = 1.0;       // [1/s] omega without gravity

}  // namespace

BalanceTask::BalanceTask(std::string name, const Robot& robot, const BalanceTaskOptions& options)
    : Task(std::move(name), options.polygon.rows(), robot),
      polygon_(options.polygon, name_),
      reference_(robot, options.reference),
      com_(robot) {
  require(std::isfinite(options.margin) && std::isfinite(options.height),
          "margin and height of task '" + name_ + "' want finite numbers [m]");
  lower_.setConstant(options.margin);
  upper_.setConstant(std::numeric_limits<double>::infinity());
  require_one_tree(robot, name_);
  BalanceTask::update(robot);
  const double h = std::max(std::abs(com_.position.z() - options.height), kLeastHeight);
  set_gain(std::max(std::sqrt(robot.gravity().norm() / h), kSlowest));
}

void BalanceTask::update(const Robot& robot) {
  require_robot(robot);
  reference_.measure(robot);
  com_.measure_com(robot);
  reference_.express(com_);
  const Matrix& n = polygon_.normals();
  const Matrix& J = com_.jacobian;
  for (Index i = 0; i < rows(); ++i) {
    error_[i] = n.row(i).dot(com_.position.head<2>().transpose() - polygon_.corners().row(i));
    jacobian_.row(i) = n(i, 0) * J.row(0) + n(i, 1) * J.row(1);
  }
  drift_.noalias() = n * com_.drift.head<2>();
}

void BalanceTask::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

}  // namespace hurcules
