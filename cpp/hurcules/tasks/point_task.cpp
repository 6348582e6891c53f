#include "hurcules/tasks/point_task.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {

PointTask::PointTask(std::string name, const Robot& robot, PointTaskOptions options)
    : ValueTask(std::move(name), options.axes.rows(), robot),
      axes_(std::move(options.axes)),
      shift_(Vector::Zero(rows())),
      reference_(robot, options.reference),
      point_(robot) {
  const std::string came = std::to_string(axes_.rows()) + " x " + std::to_string(axes_.cols());
  require(axes_.cols() == 3 && axes_.rows() >= 1 && axes_.rows() <= 3,
          "axes of task '" + name_ + "' want shape (1 to 3, 3), " + came + " came");
  require(axes_.allFinite(), "axes of task '" + name_ + "' want finite values");
  require(axes_.rowwise().squaredNorm().minCoeff() > 0.0,
          "axes of task '" + name_ + "' want a direction in each row, one of length 0 came");
  axes_.rowwise().normalize();
  const double volume = (axes_ * axes_.transpose()).determinant();
  require(volume > 1e-12, "axes of task '" + name_ + "' want directions that differ");
  max_speed_ = 0.5;
}

Vector3 PointTask::world_position() const {
  return reference_.point_in_world(point_.position);
}

Vector3 PointTask::world_target() const {
  const Matrix AAt = axes_ * axes_.transpose();
  const Vector3 way = axes_.transpose() * AAt.ldlt().solve(target_ - value_);
  return reference_.point_in_world(point_.position + way);
}

double PointTask::lever() const {
  if (rows() == 3) return 0.0;
  const double most = point_.jacobian.colwise().squaredNorm().maxCoeff();
  return std::sqrt(most) * weights().maxCoeff();
}

void PointTask::turn_axes(const Matrix& axes) {
  for (Index row = 0; row < rows(); ++row)
    shift_[row] += (axes_.row(row) - axes.row(row)).dot(point_.position);
  axes_ = axes;
}

void PointTask::save_axes(StateWriter& writer) const {
  for (Index row = 0; row < rows(); ++row)
    for (Index i = 0; i < 3; ++i) writer.put(axes_(row, i));
  writer.put(shift_);
}

void PointTask::restore_axes(StateReader& reader) {
  for (Index row = 0; row < rows(); ++row)
    for (Index i = 0; i < 3; ++i) axes_(row, i) = reader.get();
  reader.get(shift_);
}

void PointTask::measure(const Robot& robot) {
  reference_.measure(robot);
  measure_point(robot, point_);
  reference_.express(point_);
  value_.noalias() = axes_ * point_.position;
  value_ += shift_;
  const Matrix& J = point_.jacobian;
  for (Index row = 0; row < rows(); ++row)
    jacobian_.row(row) =
        axes_(row, 0) * J.row(0) + axes_(row, 1) * J.row(1) + axes_(row, 2) * J.row(2);
  drift_.noalias() = axes_ * point_.drift;
}

}  // namespace hurcules
