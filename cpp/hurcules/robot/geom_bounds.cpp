#include "hurcules/robot/geom_bounds.hpp"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/types.hpp"

namespace hurcules {

namespace {

struct Box {
  Vector3 centre, half;  // [m]
  Matrix3 axes;          // columns
};

Box box_of(const mjModel* m, const mjData* d, int geom) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Box box;
  const mjtNum* const aabb = m->geom_aabb + 6 * geom;  // in the geom's own frame
  box.axes = Eigen::Map<const RowMajor>(d->geom_xmat + 9 * geom);
  box.centre = Eigen::Map<const Vector3>(d->geom_xpos + 3 * geom) +
               box.axes * Eigen::Map<const Vector3>(aabb);
  box.half = Eigen::Map<const Vector3>(aabb + 3);
  return box;
}

// of a ball from a plane
double height(const mjModel* m, const mjData* d, int plane, int ball) {
  const double* const R = d->geom_xmat + 9 * plane;
  const Vector3 up(R[2], R[5], R[8]);
  const Vector3 way = Eigen::Map<const Vector3>(d->geom_xpos + 3 * ball) -
                      Eigen::Map<const Vector3>(d->geom_xpos + 3 * plane);
  return up.dot(way) - m->geom_rbound[ball];
}

}  // namespace

double sphere_gap(const mjModel* m, const mjData* d, int first, int second) {
  if (m->geom_type[first] == mjGEOM_PLANE) return height(m, d, first, second);
  if (m->geom_type[second] == mjGEOM_PLANE) return height(m, d, second, first);
  const double between = mju_dist3(d->geom_xpos + 3 * first, d->geom_xpos + 3 * second);
  return between - m->geom_rbound[first] - m->geom_rbound[second];
}

double box_gap(const mjModel* m, const mjData* d, std::pair<int, int> geoms, double enough) {
  const auto [first, second] = geoms;
  if (m->geom_type[first] == mjGEOM_PLANE || m->geom_type[second] == mjGEOM_PLANE) {
    return -std::numeric_limits<double>::infinity();
  }
  const Box a = box_of(m, d, first), b = box_of(m, d, second);
  const Matrix3 R = a.axes.transpose() * b.axes, size = R.cwiseAbs();
  const Vector3 t = a.axes.transpose() * (b.centre - a.centre);
  // along the axes of a, then along those of b
  const Vector3 along_a = t.cwiseAbs() - a.half - size * b.half;
  const Vector3 along_b = (R.transpose() * t).cwiseAbs() - b.half - size.transpose() * a.half;
  double gap = std::max(along_a.maxCoeff(), along_b.maxCoeff());
  if (gap >= enough) return gap;
  // across an edge of each, e_i x R e_j
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double between = std::abs(t[i2] * R(i1, j) - t[i1] * R(i2, j)) -
                             a.half[i1] * size(i2, j) - a.half[i2] * size(i1, j) -
                             b.half[j1] * size(i, j2) - b.half[j2] * size(i, j1);
      if (between <= 0.0 && gap >= 0.0) continue;
      const double length = std::sqrt(R(i1, j) * R(i1, j) + R(i2, j) * R(i2, j));
      if (length < 1e-6) continue;  // parallel edges: the axes above tell
      gap = std::max(gap, between / length);
    }
  }
  return gap;
}

}  // namespace hurcules
