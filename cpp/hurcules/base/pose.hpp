// Rotations as vectors: exponential, logarithm and their Jacobians, exact over the whole group.
//
//   R = exp([r]x),  r = log(R),  |r| <= pi  (at pi the sign of r is arbitrary)
//   d/dt exp([r]x) = [Jl(r) rdot]x exp([r]x) = exp([r]x) [Jr(r) rdot]x,   Jr(r) = Jl(-r)
// Formulas: [S 143-146] = Sola, Deray, Atchuthan, "A micro Lie theory", arXiv 1812.01537.
#pragma once

#include "hurcules/base/types.hpp"

namespace hurcules {

// [r]x: skew(a) * b = a x b
[[nodiscard]] Matrix3 skew(const Vector3& r);
// R of a rotation vector [rad]
[[nodiscard]] Matrix3 rotation_exp(const Vector3& r);
// R of a quaternion w, x, y, z of any length above 0, as qpos has it
[[nodiscard]] Matrix3 rotation_of(const double* quaternion);
// as MuJoCo has it in its arrays
[[nodiscard]] inline Eigen::Map<const Vector3> vector_of(const double* values) {
  return Eigen::Map<const Vector3>(values);
}
// rotation vector [rad] of R
[[nodiscard]] Vector3 rotation_log(const Matrix3& R);
// inverse left Jacobian: rdot = Jl^-1(r) w for dR/dt = [w]x R; bounded for |r| <= pi
[[nodiscard]] Matrix3 left_jacobian_inverse(const Vector3& r);
// inverse right Jacobian: rdot = Jr^-1(r) w for dR/dt = R [w]x
[[nodiscard]] Matrix3 right_jacobian_inverse(const Vector3& r);
// d/dt (Jl^-1(r)) w with w held, for a rotation vector that changes by rdot
[[nodiscard]] Vector3 left_jacobian_inverse_rate(const Vector3& r, const Vector3& rdot,
                                                 const Vector3& w);
// true if R is a rotation to 1e-6: orthonormal and right-handed
[[nodiscard]] bool is_rotation(const Matrix3& R);
// the same angle in [-pi, pi]
[[nodiscard]] double wrap_angle(double angle);

}  // namespace hurcules
