// Hierarchies as a two-armed robot makes them: Jacobian rows in mixed units, speed limits that bind
// on one side, locked joints, a posture at the end.
#pragma once

#include "support/draw.hpp"

namespace hurcules_test {

// joints first .. first + count - 1 move the point: lever arms [m], or axes [-] of the rotation
inline Matrix jacobian_rows(Draw& draw, Index m, Index n, Index first, Index count, double unit) {
  Matrix J = Matrix::Zero(m, n);
  J.middleCols(first, count) = unit * draw.unit_rows(m, count) * std::sqrt(count);
  // the base: tracks [m/s] and yaw
  J.leftCols(2) = draw.unit_rows(m, 2) * draw.choose({0.05, 1.0});
  return J;
}

inline Level speed_limits(Draw& draw, Index n) {
  Vector lower = -draw.uniform_vector(n, 0.0, 1.5), upper = draw.uniform_vector(n, 0.0, 1.5);
  for (Index j = 0; j < n; ++j) {
    if (draw.chance(0.1)) lower[j] = 0.0;              // at its stop
    if (draw.chance(0.05)) lower[j] = upper[j] = 0.0;  // locked
    if (draw.chance(0.05)) upper[j] = kNoLimit;
  }
  return hurcules::make_bounds(lower, upper);
}

inline Hierarchy robot_like(Draw& draw, double rho) {
  const Index n = draw.integer(8, 24), arm = (n - 2) / 2;
  Hierarchy levels = {speed_limits(draw, n)};
  for (const Index first : {Index{2}, 2 + arm}) {
    const double reach = draw.choose({0.2, 1.0, 3.0});
    levels.push_back(equality(jacobian_rows(draw, 3, n, first, arm, 0.4),
                              reach * draw.uniform_vector(3, -1.0, 1.0), rho));
    levels.push_back(equality(jacobian_rows(draw, 3, n, first, arm, 1.0),
                              reach * draw.uniform_vector(3, -1.0, 1.0), rho));
    levels.push_back(equality(jacobian_rows(draw, 1, n, first, arm, 0.05),  // swivel
                              0.1 * draw.vector(1), rho));
  }
  if (draw.chance(0.5)) {  // the centre of mass over its support, [m], and a distance kept, [mm]
    levels.insert(levels.begin() + 1,
                  interval(jacobian_rows(draw, 2, n, 0, n, 0.05), Vector::Constant(2, -0.02),
                           Vector::Constant(2, 0.01), 0.0));
    levels.insert(levels.begin() + 2,
                  interval(jacobian_rows(draw, 1, n, 2, arm, 400.0), Vector::Constant(1, -kNoLimit),
                           Vector::Constant(1, draw.uniform(-50.0, 50.0)), 0.0));
  }
  if (draw.chance(0.5)) levels.push_back(equality(Matrix::Identity(n, n), draw.vector(n), rho));
  return levels;
}

}  // namespace hurcules_test
