#include "hurcules/tasks/balance_task.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/trees.hpp"
#include "hurcules/tasks/convex_polygon.hpp"

namespace hurcules {

namespace {

constexpr double kLeastHeight = 0.05;  // [m] of the centre of mass over the polygon
constexpr double kSlowest = 1.0;       // [1/s] omega without gravity
constexpr double kFarInside = 1.0;     // [m] of a row without a side

}  // namespace

BalanceTask::BalanceTask(std::string name, const Robot& robot, const BalanceTaskOptions& options)
    : Task(std::move(name), std::max(options.polygon.rows(), options.room), robot),
      corners_(Matrix::Zero(rows(), 2)),
      normals_(corners_),
      reference_(robot, options.reference),
      com_(robot) {
  require(std::isfinite(options.margin) && std::isfinite(options.height),
          "margin and height of task '" + name_ + "' want finite numbers [m]");
  lower_.setConstant(options.margin);
  upper_.setConstant(std::numeric_limits<double>::infinity());
  require_one_tree(robot, name_);
  set_polygon(options.polygon);
  BalanceTask::update(robot);
  const double h = std::max(std::abs(com_.position.z() - options.height), kLeastHeight);
  set_gain(std::max(std::sqrt(robot.gravity().norm() / h), kSlowest));
}

void BalanceTask::update(const Robot& robot) {
  require_robot(robot);
  reference_.measure(robot);
  com_.measure_com(robot);
  reference_.express(com_);
  const Matrix& n = normals_;
  const Matrix& J = com_.jacobian;
  for (Index i = 0; i < rows(); ++i) {
    error_[i] = i < sides_ ? n.row(i).dot(com_.position.head<2>().transpose() - corners_.row(i))
                           : lower_[i] + kFarInside;
    jacobian_.row(i) = n(i, 0) * J.row(0) + n(i, 1) * J.row(1);
  }
  drift_.noalias() = n * com_.drift.head<2>();
}

void BalanceTask::set_polygon(const Matrix& corners) {
  const ConvexPolygon polygon(corners, name_);
  require(polygon.sides() <= rows(), "task '" + name_ + "' was made for polygons of up to " +
                                         std::to_string(rows()) + " corners, " +
                                         std::to_string(polygon.sides()) + " came");
  sides_ = polygon.sides();
  corners_.setZero();
  normals_.setZero();
  corners_.topRows(sides_) = polygon.corners();
  normals_.topRows(sides_) = polygon.normals();
}

void BalanceTask::save(StateWriter& writer) const {
  Task::save(writer);
  writer.put(static_cast<double>(sides_));
  for (const Matrix* matrix : {&corners_, &normals_})
    for (Index i = 0; i < matrix->size(); ++i) writer.put((*matrix)(i));
}

void BalanceTask::restore(StateReader& reader) {
  Task::restore(reader);
  sides_ = reader.get_count(rows());
  for (Matrix* matrix : {&corners_, &normals_})
    for (Index i = 0; i < matrix->size(); ++i) (*matrix)(i) = reader.get();
}

void BalanceTask::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

}  // namespace hurcules
