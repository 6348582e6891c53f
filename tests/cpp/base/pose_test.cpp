// Strategy: the logarithm inverts the exponential over the whole group, and every Jacobian equals a
// central difference, from tiny turns over the switch of formulas up to just below half a turn.
// Not tested: turns of exactly pi, where the logarithm has two values (only that it is one of
// them).
#include "hurcules/base/pose.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "support/expect.hpp"

namespace {

using namespace hurcules;
using hurcules_test::near;
using hurcules_test::tolerance;

constexpr double kPi = std::numbers::pi;

Vector3 random_direction(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Vector3(normal(generator), normal(generator), normal(generator)).normalized();
}

class PoseAtAngle : public testing::TestWithParam<double> {};

TEST_P(PoseAtAngle, LogarithmInvertsExponential) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Vector3 r = GetParam() * random_direction(seed);
    EXPECT_TRUE(near(rotation_log(rotation_exp(r)), r, 1e-13)) << "seed " << seed;
  }
}

TEST_P(PoseAtAngle, LeftJacobianInverseEqualsDifferenceOfLogarithm) {
  constexpr double kStep = 1e-5;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Vector3 r = GetParam() * random_direction(seed);
    const Matrix3 R = rotation_exp(r);
    Matrix3 left, right;
    for (int i = 0; i < 3; ++i) {
      const Vector3 turn = kStep * Vector3::Unit(i);
      left.col(i) = rotation_log(rotation_exp(turn) * R) - rotation_log(rotation_exp(-turn) * R);
      right.col(i) = rotation_log(R * rotation_exp(turn)) - rotation_log(R * rotation_exp(-turn));
    }
    EXPECT_TRUE(near(left_jacobian_inverse(r), left / (2 * kStep), 1e-8)) << "seed " << seed;
    EXPECT_TRUE(near(right_jacobian_inverse(r), right / (2 * kStep), 1e-8)) << "seed " << seed;
  }
}

TEST_P(PoseAtAngle, JacobianRateEqualsDifferenceOfJacobian) {
  constexpr double kStep = 1e-5;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Vector3 r = GetParam() * random_direction(seed);
    const Vector3 rdot = random_direction(seed + 100), w = random_direction(seed + 200);
    const Vector3 difference = (left_jacobian_inverse(r + kStep * rdot) * w -
                                left_jacobian_inverse(r - kStep * rdot) * w) /
                               (2 * kStep);
    EXPECT_TRUE(near(left_jacobian_inverse_rate(r, rdot, w), difference, 1e-8)) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(FromTinyToHalfATurn, PoseAtAngle,
                         testing::Values(0.0, 1e-9, 1e-4, 0.2499999, 0.2500001, 1.0, 2.5, 3.14));

TEST(Pose, HalfATurnGivesOneOfItsTwoLogarithms) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Vector3 r = kPi * random_direction(seed);
    const Vector3 log = rotation_log(rotation_exp(r));
    EXPECT_LE(std::min((log - r).norm(), (log + r).norm()), tolerance(1e-7)) << "seed " << seed;
    EXPECT_TRUE(left_jacobian_inverse(r).allFinite());
  }
}

TEST(Pose, SeriesAndClosedFormMeet) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Vector3 axis = random_direction(seed), w = random_direction(seed + 100);
    const Vector3 below = (0.25 - 1e-14) * axis, above = (0.25 + 1e-14) * axis;
    EXPECT_TRUE(near(left_jacobian_inverse(below), left_jacobian_inverse(above), 1e-13));
    EXPECT_TRUE(near(left_jacobian_inverse_rate(below, axis, w),
                     left_jacobian_inverse_rate(above, axis, w), 1e-12));
  }
}

TEST(Pose, SkewIsTheCrossProduct) {
  const Vector3 a(1, 2, 3), b(-2, 0.5, 4);
  EXPECT_TRUE(near(skew(a) * b, a.cross(b), 1e-15));
}

TEST(Pose, WrapKeepsTheAngleOnTheCircle) {
  EXPECT_NEAR(wrap_angle(3 * kPi / 2), -kPi / 2, tolerance(1e-15));
  EXPECT_NEAR(wrap_angle(-7.0), -7.0 + 2 * kPi, tolerance(1e-15));
  EXPECT_EQ(wrap_angle(1.0), 1.0);
}

TEST(Pose, AMirrorIsNoRotation) {
  EXPECT_TRUE(is_rotation(rotation_exp(Vector3(1, 2, 3))));
  EXPECT_FALSE(is_rotation(-Matrix3::Identity()));
  EXPECT_FALSE(is_rotation(2 * Matrix3::Identity()));
  EXPECT_FALSE(is_rotation(Matrix3::Constant(std::nan(""))));
}

}  // namespace
