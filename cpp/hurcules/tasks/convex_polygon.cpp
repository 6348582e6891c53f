#include "hurcules/tasks/convex_polygon.hpp"

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

double cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::RowVector2d side(const Matrix& corners, Index i) {
  return corners.row((i + 1) % corners.rows()) - corners.row(i);
}

// +1 counterclockwise, -1 clockwise; throws unless convex
double turn_of(const Matrix& corners, const std::string& task) {
  require(corners.cols() == 2 && corners.rows() >= 3 && corners.allFinite(),
          "polygon of task '" + task + "' wants 3 or more finite corners of 2 numbers");
  const double turn = cross(side(corners, 0), side(corners, 1));
  for (Index i = 0; i < corners.rows(); ++i) {
    const double here = cross(side(corners, i), side(corners, (i + 1) % corners.rows()));
    require(here * turn > 0.0, "polygon of task '" + task +
                                   "' wants to be convex, without corners on a line; corner " +
                                   std::to_string(i + 1) + " is not");
  }
  return turn > 0.0 ? 1.0 : -1.0;
}

}  // namespace

ConvexPolygon::ConvexPolygon(const Matrix& corners, const std::string& task)
    : corners_(corners), normals_(corners.rows(), 2) {
  const double turn = turn_of(corners, task);
  for (Index i = 0; i < sides(); ++i) {
    const Eigen::RowVector2d along = side(corners, i).normalized();
    normals_.row(i) << -turn * along.y(), turn * along.x();
  }
}

}  // namespace hurcules
