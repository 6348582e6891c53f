#include "hurcules/tasks/balance_task.hpp"

#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

double cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::RowVector2d side(const Matrix& polygon, Index i) {
  return polygon.row((i + 1) % polygon.rows()) - polygon.row(i);
}

// +1 counterclockwise, -1 clockwise; throws unless convex
double turn_of(const Matrix& polygon, const std::string& name) {
  require(polygon.cols() == 2 && polygon.rows() >= 3 && polygon.allFinite(),
          "polygon of task '" + name + "' wants 3 or more finite corners of 2 numbers");
  const double turn = cross(side(polygon, 0), side(polygon, 1));
  for (Index i = 0; i < polygon.rows(); ++i) {
    const double here = cross(side(polygon, i), side(polygon, (i + 1) % polygon.rows()));
    require(here * turn > 0.0, "polygon of task '" + name +
                                   "' wants to be convex, without corners " + "on a line; corner " +
                                   std::to_string(i + 1) + " is not");
  }
  return turn > 0.0 ? 1.0 : -1.0;
}

}  // namespace

BalanceTask::BalanceTask(std::string name, const Robot& robot, const BalanceTaskOptions& options)
    : Task(std::move(name), options.polygon.rows(), robot),
      normals_(options.polygon.rows(), 2),
      offsets_(options.polygon.rows()),
      reference_(robot, options.reference),
      com_(robot) {
  const double turn = turn_of(options.polygon, name_);
  for (Index i = 0; i < rows(); ++i) {
    const Eigen::RowVector2d along = side(options.polygon, i).normalized();
    normals_.row(i) << -turn * along.y(), turn * along.x();
    offsets_[i] = normals_.row(i).dot(options.polygon.row(i));
  }
  require(std::isfinite(options.margin), "margin of task '" + name_ + "' wants a finite number");
  lower_.setConstant(options.margin);
  upper_.setConstant(std::numeric_limits<double>::infinity());
  max_speed_ = 0.3;
  BalanceTask::update(robot);
}

void BalanceTask::update(const Robot& robot) {
  require_robot(robot);
  reference_.measure(robot);
  com_.measure_com(robot);
  reference_.express(com_);
  error_.noalias() = normals_ * com_.position.head<2>();
  error_ -= offsets_;
  jacobian_.noalias() = normals_.lazyProduct(com_.jacobian.topRows(2));
  drift_.noalias() = normals_ * com_.drift.head<2>();
}

void BalanceTask::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

}  // namespace hurcules
