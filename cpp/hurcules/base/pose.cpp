#include "hurcules/base/pose.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace hurcules {
namespace {

// below this angle the closed forms lose digits to cancellation and the series is exact to 1e-14
constexpr double kSeriesAngle = 0.25;  // [rad]

// c of Jl^-1(r) = I - [r]x / 2 + c [r]x^2:  c = (1 - a/2 cot(a/2)) / a^2, a = |r|
double square_coefficient(double a) {
  const double s = a * a;
  if (a < kSeriesAngle)
    return 1.0 / 12 + s * (1.0 / 720 + s * (1.0 / 30240 + s * (1.0 / 1209600 + s / 47900160)));
  return 1 / s - 1 / (2 * a * std::tan(a / 2));
}

// (dc/da) / a
double square_coefficient_slope(double a) {
  const double s = a * a;
  if (a < kSeriesAngle) return 1.0 / 360 + s * (1.0 / 7560 + s * (1.0 / 201600 + s / 5987520));
  const double half_sine = std::sin(a / 2);
  const double slope =
      -2 / (s * a) + 1 / (2 * s * std::tan(a / 2)) + 1 / (4 * a * half_sine * half_sine);
  return slope / a;
}

}  // namespace

Matrix3 skew(const Vector3& r) {
  Matrix3 S;
  S << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return S;
}

Matrix3 rotation_exp(const Vector3& r) {
  const double angle = r.norm();
  if (angle == 0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, r / angle).toRotationMatrix();
}

Matrix3 rotation_of(const double* quaternion) {
  const double* const q = quaternion;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

Vector3 rotation_log(const Matrix3& R) {
  const Eigen::Quaterniond quaternion(R);
  const double sine = quaternion.vec().norm();  // of half the angle
  // a half angle above pi/2 is the same rotation the short way round
  const double sign = quaternion.w() < 0 ? -1 : 1;
  if (sine == 0) return Vector3::Zero();
  return 2 * std::atan2(sine, sign * quaternion.w()) * sign / sine * quaternion.vec();
}

Matrix3 left_jacobian_inverse(const Vector3& r) {
  const Matrix3 S = skew(r);
  return Matrix3::Identity() - 0.5 * S + square_coefficient(r.norm()) * S * S;  // [S 146]
}

Matrix3 right_jacobian_inverse(const Vector3& r) {
  return left_jacobian_inverse(-r);
}  // [S 144]

Vector3 left_jacobian_inverse_rate(const Vector3& r, const Vector3& rdot, const Vector3& w) {
  const double angle = r.norm();
  // chain rule over the three factors of c [r]x [r]x w, with d|r|/dt = r . rdot / |r|
  const Vector3 turned = r.cross(w);
  return -0.5 * rdot.cross(w) + square_coefficient_slope(angle) * r.dot(rdot) * r.cross(turned) +
         square_coefficient(angle) * (rdot.cross(turned) + r.cross(rdot.cross(w)));
}

bool is_rotation(const Matrix3& R) {
  return R.allFinite() && (R * R.transpose() - Matrix3::Identity()).norm() < 1e-6 &&
         R.determinant() > 0;
}

double wrap_angle(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

}  // namespace hurcules
